/* A program beside its driver as a library: its own self_test() counts, and what nothing calls is
 * not missed. */
extern int driver_answer(void);

int self_test(void) {
  return 0;
}

int main(void) {
  return driver_answer() == 42 ? self_test() : 1;
}
