#pragma once

#include <facts/unit.h>
#include <hal/hal.h>
#include <marker/input/image_file.h>

/// How a design says that it takes images.
namespace platform::input {

/// What a design says that takes images of that size, 8 bits a pixel. `corrects_lens`: its programs
/// free what they see from the lens.
facts::InputNeed image_need(ImageSize size, bool corrects_lens = false);

/// The size that such a design takes. Throws vp::InputError if it takes no images.
ImageSize image_size(const facts::InputNeed& need);

/// Says which camera took the image (Design::describe).
void describe_camera(const facts::UnitInput& input, hal_frame& frame);

}  // namespace platform::input
