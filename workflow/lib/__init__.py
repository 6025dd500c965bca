"""What a script of a panel imports: loading, units, tables, fits, style, captions, saving."""
