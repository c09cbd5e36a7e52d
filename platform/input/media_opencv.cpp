// The plug-in behind input/media.h: OpenCV's image and video codecs.
#include <input/media.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace platform::input {

namespace {

/// Codecs write what they think of a file to stderr. While this lives, that goes into memory
/// instead, to be judged.
class StderrCapture {
 public:
  StderrCapture() : saved_(::dup(STDERR_FILENO)), memory_(::memfd_create("codec", MFD_CLOEXEC)) {
    if (memory_ >= 0) ::dup2(memory_, STDERR_FILENO);
  }
  ~StderrCapture() {
    if (saved_ >= 0) ::dup2(saved_, STDERR_FILENO);
    ::close(saved_);
    ::close(memory_);
  }
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  std::string text() const {
    std::string text(1 << 12, '\0');
    const ssize_t size = ::pread(memory_, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int saved_;
  int memory_;
};

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

/// libjpeg fills what is missing with grey and only says so.
bool complains(const std::string& noise) {
  return noise.find("Corrupt JPEG data") != std::string::npos ||
         noise.find("Premature end of JPEG") != std::string::npos;
}

class OpencvVideo : public VideoStream {
 public:
  explicit OpencvVideo(cv::VideoCapture capture) : capture_(std::move(capture)) {}

  std::optional<GreyImage> next() override {
    const StderrCapture silence;
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

class OpencvMedia : public Media {
 public:
  OpencvMedia() {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  }

  bool is_image(const std::string& path) const override {
    const StderrCapture silence;
    try {
      return cv::haveImageReader(path);
    } catch (const cv::Exception&) {
      return false;
    }
  }

  std::optional<GreyImage> read_image(const std::string& path) const override {
    const StderrCapture noise;
    try {
      const cv::Mat picture = cv::imread(path, cv::IMREAD_GRAYSCALE);
      if (picture.empty() || complains(noise.text())) return std::nullopt;
      return grey_image(picture);
    } catch (const cv::Exception&) {
      return std::nullopt;
    }
  }

  std::unique_ptr<VideoStream> open_video(const std::string& path) const override {
    const StderrCapture silence;
    cv::VideoCapture capture;
    for (const int backend : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG, cv::CAP_GSTREAMER}) {
      try {
        if (capture.open(path, backend)) return std::make_unique<OpencvVideo>(std::move(capture));
      } catch (const cv::Exception&) {
        continue;  // the next one may know the format
      }
    }
    return nullptr;
  }
};

}  // namespace

}  // namespace platform::input

const platform::input::Media* MARKERVP_MEDIA_ENTRY() {
  static const platform::input::OpencvMedia media;
  return &media;
}
