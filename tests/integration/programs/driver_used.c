int driver_answer(void) {
  return 42;
}
