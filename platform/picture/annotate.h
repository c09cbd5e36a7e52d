#pragma once

#include <string>

#include <picture/picture.h>
#include <report/result.h>
#include <scene/grey_image.h>

namespace platform::picture {

/// The image with what was found in it: corners as small triangles that point like the tip, blobs'
/// boxes (thin), candidates, the marker's outline with its corners numbered clockwise from its own
/// top left, the axes u, v, w, the ID; below a strip with time, pose and error, and the legend. The
/// image is enlarged by whole numbers so that single pixels and features stay visible (twice at 640
/// px); colours are Okabe and Ito's, told apart with any colour vision.
Picture annotate(const GreyImage& image, const report::FrameReport& frame);

/// File name of a frame's picture: "0007_photo.png". Unusual characters of the input's name become
/// '_'.
std::string picture_name(const report::FrameReport& frame);

}  // namespace platform::picture
