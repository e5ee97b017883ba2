"""The site: the guides and references of a project as static pages."""
