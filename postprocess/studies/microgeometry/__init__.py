"""Predicted against simulated roughness inside the contact: ``scripts/study microgeometry``."""
