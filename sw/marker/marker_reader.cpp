#include <marker/marker_reader.h>
#include <marker/rectification.h>
#include <marker/work.h>

#include <array>

namespace marker {
namespace {

/// Where a cell is looked at, shares of its side: blur and neighbours reach less far.
constexpr std::array<double, 3> places = {0.3, 0.5, 0.7};

/// The pixel that holds an ideal point; `otherwise` outside of the picture.
double grey_at(const GreyImage& image, const Lens& lens, Point ideal, double otherwise) {
  const Point p = distort(lens, ideal);
  if (!(p.x >= 0 && p.x < image.width && p.y >= 0 && p.y < image.height)) return otherwise;
  return image.pixels[std::size_t{static_cast<std::uint32_t>(p.y)} * image.width +
                      static_cast<std::uint32_t>(p.x)];
}

}  // namespace

CellReading read_cells(const GreyImage& image, const Lens& lens, const QuadFit& fit,
                       std::uint32_t cells) {
  const Quad& c = fit.ideal;
  const std::uint32_t side = cells + 2;
  const Homography homography = make_homography({c[0], c[1], c[3], c[2]}, side);
  constexpr double samples = places.size() * places.size();
  const double limit = (fit.dark + fit.bright) / 2 * samples;
  CellReading reading{};
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      double sum = 0;
      for (const double v : places) {
        for (const double u : places) {
          Point ideal{-1, -1};
          transform(homography, {column + u, row + v}, ideal);
          sum += grey_at(image, lens, ideal, fit.bright);
        }
      }
      const bool black = sum < limit;
      if (row == 0 || column == 0 || row + 1 == side || column + 1 == side) {
        if (!black) ++reading.white_border;
      } else {
        reading.word = reading.word << 1 | (black ? 1 : 0);
      }
    }
  }
  work(Work::grid_samples, std::uint64_t{side} * side * places.size() * places.size());
  work(Work::cells, std::uint64_t{side} * side);
  return reading;
}

Refusal read_marker(const GreyImage& image, const Lens& lens, const Quad& guess,
                    const CodeBook& book, const DetectionOptions& options, DetectedMarker& marker) {
  const std::uint32_t cells = book.dictionary().cells;
  QuadFitOptions fit_options = options.fit;
  fit_options.cells = cells + 2;
  const QuadFit fit = fit_quad(image, lens, guess, fit_options);
  if (fit.refusal != Refusal::none) return fit.refusal;
  const CellReading reading = read_cells(image, lens, fit, cells);
  if (reading.white_border > options.white_border) return Refusal::border;
  const CodeBook::Match match = book.look_up(reading.word);
  if (!match.found) return Refusal::unknown;
  marker.id = match.id;
  marker.corrected = match.corrected;
  // Turned by r quarters, the marker's own top left is the r-th corner clockwise from the first.
  marker.fit = counted_from(fit, match.rotation);
  return Refusal::none;
}

Refusal detect_marker(const GreyImage& image, const Lens& lens, const Extremes& blob,
                      const CodeBook& book, const DetectionOptions& options,
                      DetectedMarker& marker) {
  Quad guess{};
  if (!largest_quad(blob, guess)) return Refusal::shape;
  return read_marker(image, lens, guess, book, options, marker);
}

}  // namespace marker
