"""Progress of make figures."""
