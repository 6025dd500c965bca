"""One function per statement of the paper, and the verdict."""
