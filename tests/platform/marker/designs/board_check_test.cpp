#include <marker/designs/improved/board_check.h>

#include <boost/test/unit_test.hpp>

#include <marker/scene/pose.h>

using namespace platform;

namespace {

const Camera camera = Camera::for_resolution(640, 480);
const Pose pose = pose_from_centre(rotation_x(20) * rotation_y(-15), {0.1, 0.05, 0.9});

marker::Board charuco(std::uint32_t columns, std::uint32_t rows, double square, double side,
                      bool white_first) {
  marker::Board board;
  board.kind = marker::Board::Kind::charuco;
  board.marker_side = side;
  board.charuco = {columns, rows, square, side, white_first};
  return board;
}

/// The markers of a board as the camera sees them.
std::vector<BoardMarker> seen(const marker::Board& board) {
  std::vector<BoardMarker> markers;
  marker::Places places;
  for (std::uint32_t id = 0; board.find(id, places); ++id) {
    BoardMarker& marker = markers.emplace_back();
    marker.id = static_cast<int>(id);
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = transform(pose, {places[i][0], places[i][1], places[i][2]});
      marker.ideal_px[i] = {camera.fx * p.x() / p.z() + camera.cx,
                            camera.fy * p.y() / p.z() + camera.cy};
    }
  }
  return markers;
}

const marker::Board true_board = charuco(5, 7, 0.04, 0.03, false);

bool has(const std::vector<std::string>& layouts, const std::string& layout) {
  for (const std::string& each : layouts)
    if (each.find(layout) == 0) return true;
  return false;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(board_check)

BOOST_AUTO_TEST_CASE(the_true_board_fits) {
  std::vector<BoardMarker> markers = seen(true_board);
  markers[3].ideal_px[1].x += 2;
  const BoardFit fit = check_board(true_board, camera, pose, markers);
  BOOST_TEST(fit.is_good());
  BOOST_TEST(fit.strangers == 0u);
  BOOST_TEST(*markers[3].residual_px == 1.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(*markers[0].residual_px < 1e-9);
  BOOST_TEST(fit.residual_px == 1 / std::sqrt(17.0), boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(another_board_does_not_fit_and_the_true_one_is_named) {
  std::vector<BoardMarker> markers = seen(true_board);
  for (const marker::Board& board :
       {charuco(7, 5, 0.04, 0.03, false), charuco(5, 7, 0.04, 0.03, true),
        charuco(6, 7, 0.04, 0.03, false)}) {
    BOOST_TEST(!check_board(board, camera, pose, markers).is_good());
    const auto layouts = fitting_layouts(board, markers);
    BOOST_TEST(has(layouts,
                   "sw.board=charuco sw.board_columns=5 sw.board_rows=7 (or more) "
                   "sw.board_white_first=0 sw.board_square=0.04m"));
  }
}

BOOST_AUTO_TEST_CASE(another_size_of_the_squares_is_found) {
  const std::vector<BoardMarker> markers = seen(true_board);
  const auto layouts = fitting_layouts(charuco(5, 7, 0.05, 0.03, false), markers);
  std::vector<BoardMarker> same = markers;
  BOOST_TEST(check_board(charuco(5, 7, 0.041, 0.03, false), camera, pose, same).is_odd());
  BOOST_TEST(has(layouts,
                 "sw.board=charuco sw.board_columns=5 sw.board_rows=7 (or more) "
                 "sw.board_white_first=0 sw.board_square=0.04m"));
}

BOOST_AUTO_TEST_CASE(a_grid_is_told_from_a_chessboard) {
  marker::Board grid;
  grid.kind = marker::Board::Kind::grid;
  grid.marker_side = 0.03;
  grid.grid = {4, 3, 0.03, 0.01, 0};
  const auto layouts = fitting_layouts(true_board, seen(grid));
  BOOST_TEST(has(layouts,
                 "sw.board=grid sw.board_columns=4 sw.board_rows=3 (or more) "
                 "sw.board_gap=0.01m"));
}

BOOST_AUTO_TEST_CASE(markers_of_no_board_fit_none) {
  std::vector<BoardMarker> markers = seen(true_board);
  for (std::size_t i = 0; i < markers.size(); ++i)
    markers[i].id = static_cast<int>(i * 7 % markers.size());
  BOOST_TEST(fitting_layouts(true_board, markers).empty());
  markers.resize(1);
  BOOST_TEST(fitting_layouts(true_board, markers).empty(), "one marker fits any");
}

BOOST_AUTO_TEST_CASE(markers_beside_the_board_are_strangers_and_twins_do_not_count) {
  std::vector<BoardMarker> markers = seen(true_board);
  markers[0].id = 200;
  markers[1].id = markers[2].id;
  const BoardFit fit = check_board(true_board, camera, pose, markers);
  BOOST_TEST(fit.strangers == 1u);
  BOOST_TEST(fit.is_good());
  BOOST_TEST(!markers[1].residual_px.has_value());
  BOOST_TEST(!markers[0].residual_px.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
