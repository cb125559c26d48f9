"""Arguments of the commands; their work is imported when they run, so that help is quick."""
