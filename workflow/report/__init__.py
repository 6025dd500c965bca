"""The report of a quality, and the gallery."""
