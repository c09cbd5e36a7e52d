#include <host/gnuplot.h>

#include <vp/output_file.h>

namespace platform::host {

CommandEnd draw_with_gnuplot(const std::string& file, const std::string& script) {
  vp::OutputFile plot(file, vp::OutputFile::By::name);
  const vp::PartFile commands(plot.part() + ".gnuplot");
  vp::write_file(commands.path(), "set output " + gnuplot_quoted(plot.part()) + "\n" + script);
  CommandEnd end = run_command({"gnuplot", commands.path()});
  if (end.exit_code == 0) plot.commit();
  return end;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace platform::host
