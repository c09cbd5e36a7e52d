// A shared object that says nothing of itself.
#include <zynq/design.h>

const platform::DesignInfo unused{};
