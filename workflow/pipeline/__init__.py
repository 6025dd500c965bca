"""Planning, making and checking of products."""
