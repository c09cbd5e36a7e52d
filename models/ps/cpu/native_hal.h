#pragma once

namespace ps {

/// Does nothing. A reference to it puts the HAL's functions into an executable whose programs are
/// all plug-ins.
void use_native_hal();

}  // namespace ps
