// A shared object that says nothing of itself.
#include <chip/system/design.h>

const platform::DesignInfo unused{};
