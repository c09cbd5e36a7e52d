#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <study/engine.h>
#include <study/store.h>
#include <vp/ip.h>

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

namespace {

using namespace platform;

double cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Runs all points of the sweep, one after another in this process.
template <class Run>
double seconds_a_point(const study::Manifest& manifest, const Run& run) {
  const double begin = cpu_seconds();
  for (const study::Point& point : manifest.points) {
    if (run(manifest.setup(point)) != 0) throw std::runtime_error("a point failed");
  }
  return (cpu_seconds() - begin) / static_cast<double>(manifest.points.size());
}

void measure(const std::string& folder, const std::string& output) {
  const study::Manifest manifest = study::Store(folder).read_manifest();
  std::vector<std::size_t> all(manifest.points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  cli::warm_up(manifest, all);
  std::ostringstream said;
  const double bare = seconds_a_point(manifest, [&](const study::Setup& run) {
    study::RunResult result;
    return cli::run_point(run, result, said);
  });
  const double written = seconds_a_point(manifest, [&](const study::Setup& run) {
    cli::RunOptions options = cli::options_of(run);
    options.output = output;
    options.no_pictures = options.no_report = options.quiet = true;
    std::ostringstream out;
    vp::begin_fresh_context();
    return cli::run(options, {}, out, said);
  });
  std::cout << 1e3 * bare << ' ' << 1e3 * written << std::endl;
}

}  // namespace

/// The points of a sweep's folder without a sweep, all in this process: prints processor time a
/// point in milliseconds, of the runs alone, and of runs that write their result.json as `markervp
/// run` does.
int main(int argc, char** argv) {
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  try {
    if (argc != 3) throw std::runtime_error("name the folders of a sweep and of results");
    measure(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
