// A shared object that calls what nothing defines.
extern "C" void nothing_has_this();

extern "C" void call() {
  nothing_has_this();
}
