// The plug-in behind input/media.h: OpenCV's image and video codecs.
#include <host/stderr_capture.h>
#include <marker/input/media.h>

#include <tiffio.h>

#include <cstdarg>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace platform::input {

namespace {

constexpr double white = 255;

GreyImage grey_image(const cv::Mat& picture) {
  cv::Mat grey;
  switch (picture.channels()) {
    case 1:
      grey = picture;
      break;
    case 3:
      cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
      break;
    default:
      cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
      break;
  }
  GreyImage image{grey.cols, grey.rows, {}};
  image.pixels.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y) {
    const std::uint8_t* row = grey.ptr(y);
    image.pixels.insert(image.pixels.end(), row, row + grey.cols);
  }
  return image;
}

/// Floating-point samples as grey levels.
Decoded<GreyImage> levels(const cv::Mat& picture) {
  if (picture.empty()) return Unreadable::damaged;
  double least = 0, most = 0;
  cv::minMaxLoc(picture.reshape(1), &least, &most);
  const bool is_finite = cv::checkRange(picture);
  if (!is_finite || least < 0 || most > white) return Unreadable::no_levels;
  cv::Mat whole;
  picture.convertTo(whole, CV_8U, most <= 1 ? white : 1);
  return grey_image(whole);
}

/// libtiff leaves black what it cannot decompress, and only says so.
thread_local bool tiff_complains = false;

void note_tiff_error(thandle_t, const char*, const char*, std::va_list) {
  tiff_complains = true;
}

/// libjpeg fills what is missing with grey and only says so.
bool complains(const std::string& noise) {
  return noise.find("Corrupt JPEG data") != std::string::npos ||
         noise.find("Premature end of JPEG") != std::string::npos;
}

class OpencvVideo : public VideoStream {
 public:
  explicit OpencvVideo(const cv::VideoCapture& capture) : capture_(capture) {}

  std::optional<GreyImage> next() override {
    const host::StderrCapture silence;
    cv::Mat picture;
    try {
      if (!capture_.read(picture) || picture.empty() || picture.depth() != CV_8U)
        return std::nullopt;
      return grey_image(picture);
    } catch (const cv::Exception&) {
      return std::nullopt;
    }
  }

  std::uint64_t promised_frames() const override {
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    return count >= 1 ? static_cast<std::uint64_t>(count) : 0;
  }

 private:
  cv::VideoCapture capture_;
};

/// The containers that are read. Playlists and scripts (concat, hls, sdp, image2) are not among
/// them: they name other files, FIFOs and addresses, which FFmpeg would open in turn.
constexpr const char* containers =
    "asf,avi,dv,flv,gif,h264,hevc,ivf,m4v,matroska,mjpeg,mov,mpeg,mpegts,mpegvideo,mxf,nut,ogg,"
    "yuv4mpegpipe";

/// A codec that finds nothing in a gigantic file gives up after this long.
constexpr int patience_ms = 30'000;

class OpencvMedia : public Media {
 public:
  OpencvMedia() {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 1);  // AV_LOG_QUIET
    ::setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS",
             ("protocol_whitelist;file|format_whitelist;" + std::string(containers)).c_str(), 1);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    TIFFSetErrorHandlerExt(&note_tiff_error);
  }

  Decoded<GreyImage> decode_image(const std::vector<std::uint8_t>& bytes,
                                  Samples samples) const override {
    const host::StderrCapture noise;
    tiff_complains = false;
    try {
      const bool is_floating = samples == Samples::floating;
      const cv::Mat picture =
          cv::imdecode(bytes, is_floating ? cv::IMREAD_UNCHANGED : cv::IMREAD_GRAYSCALE);
      if (tiff_complains) return Unreadable::damaged;
      if (is_floating) return levels(picture);
      if (picture.empty() || complains(noise.text())) return Unreadable::damaged;
      return grey_image(picture);
    } catch (const cv::Exception& exception) {
      const bool limit = exception.err.find("CV_IO_MAX_IMAGE") != std::string::npos;
      return limit ? Unreadable::too_large : Unreadable::damaged;
    }
  }

  /// FFmpeg only: OpenCV's other backends wait without limit for what a damaged file never gives
  /// (GStreamer), or know nothing that FFmpeg does not.
  Decoded<std::unique_ptr<VideoStream>> open_video(const std::string& path) const override {
    const host::StderrCapture silence;
    // FFmpeg takes what is before a colon for a protocol, unless a slash comes first.
    const std::string file = std::filesystem::absolute(path).string();
    try {
      cv::VideoCapture capture(file, cv::CAP_FFMPEG,
                               {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, patience_ms,
                                cv::CAP_PROP_READ_TIMEOUT_MSEC, patience_ms});
      if (!capture.isOpened()) return Unreadable::damaged;
      const double pixels =
          capture.get(cv::CAP_PROP_FRAME_WIDTH) * capture.get(cv::CAP_PROP_FRAME_HEIGHT);
      if (pixels > static_cast<double>(most_pixels)) return Unreadable::too_large;
      return std::make_unique<OpencvVideo>(std::move(capture));
    } catch (const cv::Exception&) {
      return Unreadable::damaged;
    }
  }
};

}  // namespace

}  // namespace platform::input

const platform::input::Media* MARKERVP_MEDIA_ENTRY() {
  static const platform::input::OpencvMedia media;
  return &media;
}
