"""Does the paper hold? Claims, verdicts, the panels that serve them, report and gallery."""
