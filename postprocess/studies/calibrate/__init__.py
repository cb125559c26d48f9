"""Calibration of declared errors: a stored sample of contacts, and the factors that follow."""
