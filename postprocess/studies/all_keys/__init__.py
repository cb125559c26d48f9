"""Test of declared errors: random inputs, again on twice the cells."""
