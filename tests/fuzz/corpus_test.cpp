// Every seed, and what becomes of it when bytes change, are lost or come twice: a target either
// returns or throws an error with a message for the user. scripts/fuzz looks for more.
#include "targets.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <vp/random.h>

namespace fs = std::filesystem;

namespace {

constexpr int mutants_of_a_seed = 150;

std::vector<std::string> seeds_of(const std::string& target) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(MARKERVP_CORPUS) / target))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

/// One to four changes.
std::string mutant(std::string bytes, vp::RandomBits& random) {
  for (std::uint64_t changes = 1 + random.next() % 4; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random.next() % bytes.size();
    const std::size_t length = 1 + random.next() % std::min<std::size_t>(16, bytes.size() - at);
    switch (random.next() % 6) {
      case 0:
        bytes[at] = static_cast<char>(random.next());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.next() % 8);
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.resize(at);
        break;
      default:
        bytes.insert(at,
                     std::to_string(random.next() % 5 == 0 ? random.next() : random.next() % 3));
    }
  }
  return bytes;
}

std::string failure(const fuzz::Target& target, const std::string& bytes) {
  try {
    fuzz::feed(target, bytes);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "something that is no exception";
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(corpus)

BOOST_AUTO_TEST_CASE(each_target_takes_its_seeds_and_their_mutants) {
  for (const fuzz::Target& target : fuzz::targets()) {
    const std::vector<std::string> seeds = seeds_of(target.name);
    BOOST_TEST(!seeds.empty(), target.name << " has no seed in tests/fuzz/corpus");
    const auto accepted = std::count_if(seeds.begin(), seeds.end(), [&](const std::string& seed) {
      return fuzz::feed(target, seed);
    });
    BOOST_TEST(accepted > 0, target.name << " refuses all of its seeds");
    vp::RandomBits random(1);
    for (const std::string& seed : seeds) {
      BOOST_TEST(failure(target, seed) == "", target.name);
      for (int i = 0; i < mutants_of_a_seed; ++i) {
        const std::string bytes = mutant(seed, random);
        BOOST_TEST(failure(target, bytes) == "", target.name << ": " << bytes);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_target_that_fails_is_found) {
  const fuzz::Target bad{"bad", ".txt", [](const std::string&) { throw std::logic_error("oops"); }};
  BOOST_TEST(failure(bad, "x") == "oops");
}

BOOST_AUTO_TEST_SUITE_END()
