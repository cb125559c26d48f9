"""Lambda ratios where films are as thin as surfaces are rough: ``scripts/study lambda``."""
