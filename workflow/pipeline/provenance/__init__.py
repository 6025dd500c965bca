"""Where products come from, and whether they are fresh and unmodified."""
