"""One script per panel: from results to figure, table and caption."""
