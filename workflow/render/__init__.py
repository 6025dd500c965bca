"""Rendering of a panel: from results and a script to its files and their record."""
