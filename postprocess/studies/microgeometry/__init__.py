"""Predicted against simulated roughness inside the contact: ``scripts/validate-microgeometry``."""
