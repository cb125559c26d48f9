"""What sliding does to waviness: the law of the complementary wave, and what follows from it."""
