"""Maps: one number of very many problems, over up to four parameters, on one processor or on a cluster."""
