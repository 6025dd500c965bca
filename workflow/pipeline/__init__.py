"""What is planned, made and checked."""
