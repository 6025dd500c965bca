"""What is known about this model, beyond its simulation."""
