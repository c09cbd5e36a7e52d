#pragma once

#include <marker/input/frame_source.h>
#include <marker/input/image_need.h>
#include <study/inputs.h>

/// Images as inputs of a design: scenes, image files, folders, videos.
namespace platform::input {

/// What the user asks for. Throws vp::InputError for a camera file that is wrong.
InputOptions image_options(const study::InputRequest& request);

/// The kind "images": settings `camera` and `fit`, the key `scenes` of a sweep's file.
const study::InputKind& image_input();

}  // namespace platform::input
