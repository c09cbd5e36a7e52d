#include <marker/identification.h>
#include <marker/work.h>

#include <boost/test/unit_test.hpp>

#include "fake_hal.h"

using marker::CellCounts;
using marker::Code;
using marker::Identification;

namespace {

/// Cells as a perfect rectification would leave them.
CellCounts cells_of(Code code) {
  CellCounts cells{};
  cells.samples_per_cell = 64;
  for (auto& row : cells.dark) row.fill(64);
  for (unsigned i = 0; i < 16; ++i)
    cells.dark[1 + i / 4][1 + i % 4] = code >> (15 - i) & 1 ? 64 : 0;
  return cells;
}

struct Fixture {
  Fixture() { fake_hal::reset(); }
  std::uint64_t work(marker::Work item) {
    return fake_hal::state().work[static_cast<std::uint32_t>(item)];
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(identification, Fixture)

BOOST_AUTO_TEST_CASE(all_ids_in_all_rotations) {
  for (unsigned id = 0; id < marker::dictionary_size; ++id) {
    Code code = marker::dictionary[id];
    for (unsigned rotation = 0; rotation < 4; ++rotation) {
      const Identification found = marker::identify(cells_of(code));
      BOOST_REQUIRE(found.found);
      BOOST_TEST(found.id == id);
      BOOST_TEST(found.rotation == rotation);
      BOOST_TEST(found.code == code);
      code = marker::rotate_clockwise(code);
    }
  }
}

BOOST_AUTO_TEST_CASE(work_of_one_upright_marker) {
  marker::identify(cells_of(marker::dictionary[99]));
  BOOST_TEST(work(marker::Work::cells) == 36u);
  BOOST_TEST(work(marker::Work::dictionary_compares) == 100u);
  BOOST_TEST(work(marker::Work::rotations) == 0u);
}

BOOST_AUTO_TEST_CASE(each_border_cell_counts) {
  for (unsigned i = 0; i < 36; ++i) {
    const unsigned row = i / 6;
    const unsigned column = i % 6;
    if (row % 5 != 0 && column % 5 != 0) continue;
    CellCounts cells = cells_of(marker::dictionary[99]);
    cells.dark[row][column] = 32;  // exactly half is not black
    const Identification found = marker::identify(cells);
    BOOST_TEST(!found.found);
    BOOST_TEST(!found.border);
    cells.dark[row][column] = 33;
    BOOST_TEST(marker::identify(cells).found);
  }
}

BOOST_AUTO_TEST_CASE(one_wrong_bit_is_no_marker) {
  for (unsigned bit = 0; bit < 16; ++bit) {
    const Identification found =
        marker::identify(cells_of(static_cast<Code>(marker::dictionary[99] ^ 1u << bit)));
    BOOST_TEST(!found.found);
    BOOST_TEST(found.border);
  }
}

BOOST_AUTO_TEST_CASE(black_square_is_compared_in_vain) {
  BOOST_TEST(!marker::identify(cells_of(0xFFFF)).found);
  BOOST_TEST(work(marker::Work::dictionary_compares) == 1000u);
  BOOST_TEST(work(marker::Work::rotations) == 4u);
}

BOOST_AUTO_TEST_SUITE_END()
