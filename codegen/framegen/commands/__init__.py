"""The verbs of the command, one module each; a module is imported when its verb is used."""
