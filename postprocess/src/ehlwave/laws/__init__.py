"""Laws: sources of films, friction and responses, with their errors."""
