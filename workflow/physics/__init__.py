"""Theory of this model, and what panels share of it: tables, parameters, looks."""
