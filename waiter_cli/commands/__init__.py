"""The commands, a file each: options in, one call of a stage, an exit code out."""
