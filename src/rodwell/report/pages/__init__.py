"""How a report looks: page, PDF, viewer, notebook."""
