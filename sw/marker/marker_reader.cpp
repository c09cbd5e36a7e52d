#include <marker/marker_reader.h>
#include <marker/rectification.h>
#include <marker/work.h>

namespace marker {
namespace {

/// A cell is looked at in its middle and so far from it, shares of its side: blur and neighbours
/// reach less far.
constexpr double spread = 0.2;
constexpr double samples = 9;

/// A cell in the picture: its middle, and the ways to the places right and below. Perspective and
/// lens bend nothing within a cell that matters.
struct Cell {
  Point middle, right, down;
};

Cell cell_at(const Homography& h, const Lens& lens, double u, double v) {
  const double scale = 1 / (h.h7 * u + h.h8 * v + 1);
  const Point ideal{(h.h1 * u + h.h2 * v + h.u1) * scale, (h.h4 * u + h.h5 * v + h.v1) * scale};
  const double step = spread * scale;
  Cell cell{ideal,
            {(h.h1 - ideal.x * h.h7) * step, (h.h4 - ideal.y * h.h7) * step},
            {(h.h2 - ideal.x * h.h8) * step, (h.h5 - ideal.y * h.h8) * step}};
  if (lens.is_pinhole()) return cell;
  cell.middle = distort(lens, ideal);
  for (Point* const way : {&cell.right, &cell.down}) {
    const Point there = distort(lens, {ideal.x + way->x, ideal.y + way->y});
    *way = {there.x - cell.middle.x, there.y - cell.middle.y};
  }
  return cell;
}

/// The sum of the grey values of the pixels at the nine places; `otherwise` outside of the picture.
double sum_of(const Cell& cell, const GreyImage& image, double otherwise) {
  std::uint32_t sum = 0, outside = 0;
  for (int row = -1; row <= 1; ++row) {
    double x = cell.middle.x + row * cell.down.x - cell.right.x;
    double y = cell.middle.y + row * cell.down.y - cell.right.y;
    for (int column = 0; column < 3; ++column, x += cell.right.x, y += cell.right.y) {
      if (x >= 0 && x < image.width && y >= 0 && y < image.height) {
        sum += image.pixels[std::size_t{static_cast<std::uint32_t>(y)} * image.width +
                            static_cast<std::uint32_t>(x)];
      } else {
        ++outside;
      }
    }
  }
  return sum + outside * otherwise;
}

}  // namespace

CellReading read_cells(const GreyImage& image, const Lens& lens, const QuadFit& fit,
                       std::uint32_t cells) {
  const FunctionScope scope(Function::cell_reading);
  const Quad& c = fit.ideal;
  const std::uint32_t side = cells + 2;
  const Homography homography = make_homography({c[0], c[1], c[3], c[2]}, side);
  const double limit = (fit.dark + fit.bright) / 2 * samples;
  CellReading reading{};
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const Cell cell = cell_at(homography, lens, column + 0.5, row + 0.5);
      const bool black = sum_of(cell, image, fit.bright) < limit;
      if (row == 0 || column == 0 || row + 1 == side || column + 1 == side) {
        if (!black) ++reading.white_border;
      } else {
        reading.word = reading.word << 1 | (black ? 1 : 0);
      }
    }
  }
  work(Work::codes_read, 1);
  work(Work::code_cells, std::uint64_t{side} * side);
  if (!lens.is_pinhole()) work(Work::lens_steps, std::uint64_t{3} * side * side);
  return reading;
}

Refusal read_marker(const GreyImage& image, const Lens& lens, const Quad& guess,
                    const CodeBook& book, const DetectionOptions& options, DetectedMarker& marker) {
  const std::uint32_t cells = book.dictionary().cells;
  QuadFitOptions fit_options = options.fit;
  fit_options.cells = cells + 2;
  QuadFit fit = find_quad(image, lens, guess, fit_options);
  if (fit.refusal != Refusal::none) return fit.refusal;
  const CellReading reading = read_cells(image, lens, fit, cells);
  if (fit_options.in_dma_memory) {
    work(Work::code_cells_dma, std::uint64_t{cells + 2} * (cells + 2));
  }
  if (reading.white_border > options.white_border) return Refusal::border;
  const CodeBook::Match match = book.look_up(reading.word);
  if (!match.found) return Refusal::unknown;
  // Only what is a marker is worth all of its edges.
  refine_quad(image, lens, fit_options, fit);
  if (fit.refusal != Refusal::none) return fit.refusal;
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
