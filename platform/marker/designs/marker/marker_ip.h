#pragma once

#include <chip/block_design/own_ip.h>

namespace platform {

/// The feature extraction as an IP of block designs: `markervp:marker:feature_extraction`, the pins
/// of its RTL, streams `image` and `binary`.
block_design::OwnIp marker_ip();

}  // namespace platform
