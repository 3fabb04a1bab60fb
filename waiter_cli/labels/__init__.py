"""Places names in rendered frames so that they overlap least."""
