#pragma once

#include <opencv2/core.hpp>

/// Colours that people with any colour vision can tell apart (Okabe and Ito 2008), as red, green,
/// blue.
namespace platform::picture::palette {

inline const cv::Scalar orange{230, 159, 0};
inline const cv::Scalar sky_blue{86, 180, 233};
inline const cv::Scalar bluish_green{0, 158, 115};
inline const cv::Scalar yellow{240, 228, 66};
inline const cv::Scalar blue{0, 114, 178};
inline const cv::Scalar vermillion{213, 94, 0};
inline const cv::Scalar reddish_purple{204, 121, 167};

inline const cv::Scalar ink{18, 20, 26};
inline const cv::Scalar strip{24, 27, 34};
inline const cv::Scalar text{236, 238, 242};
inline const cv::Scalar faint_text{160, 166, 178};

}  // namespace platform::picture::palette
