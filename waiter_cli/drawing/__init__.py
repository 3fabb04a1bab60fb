"""Floor plans as pictures: a `Subject` (what is to be seen) → text, SVG or PNG."""
