/* The program has a function of this name, too, and nothing defines the one that this calls. */
extern int driver_of_another_release(void);

int self_test(void) {
  return driver_of_another_release() + 1;
}
