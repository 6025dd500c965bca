"""Set-up, build, and the variables that a command keeps."""
