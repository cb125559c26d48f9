"""Waviness under slip: the law of the complementary wave, and its consequences."""
