#include "PathPlot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "Files.hpp"
#include "Ranks.hpp"

extern char** environ;

namespace atrapos {
namespace {

/// A text from a deck, or a file's name, as a string of gnuplot that is nothing but this text. Gnuplot runs
/// what is between backticks, puts in what @ names, and loses count of quotes within quotes: all that may
/// mean something is written as its octal number. What is no text (the end of a line) becomes a blank.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  bool number = false;  // a digit would go on with it
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool letter = (code >= 'a' && code <= 'z') || (code >= 'A' && code <= 'Z');
    const bool digit = code >= '0' && code <= '9';
    if (code < 0x20 || code == 0x7f) {
      result += ' ';
      number = false;
    } else if (letter || (digit && !number) || std::strchr(" .,:;()+-*/=_", c)) {
      result += c;
      number = false;
    } else {
      result += fmt::format("\\{:03o}", code);
      number = true;
    }
  }
  return result + '"';
}

const char* colour(int branch) {
  static const char* colours[] = {"#1f5fa8", "#c0392b", "#2e8b57", "#8e44ad",
                                  "#d68910", "#117a8b", "#7f8c8d"};
  return colours[branch % 7];
}

/// One panel; columns of path.csv and points.csv that are its abscissa.
std::string panel(const std::string& name, int column, int pointColumn, int stability, int branches) {
  std::string script = fmt::format("set xlabel {}\nplot ", quoted(name));
  for (int b = 0; b < branches; ++b) {
    const auto curve = [&](const std::string& where, const std::string& style) {
      script += fmt::format("'path.csv' skip 1 using {}:(${} == {}{} ? $3 : NaN) {} lc rgb '{}', \\\n  ",
                            column, stability + 1, b, where, style, colour(b));
    };
    // A thin line through everything, a thick one where the state is stable or nothing is known: NaN breaks
    // it at the others, as long as NaN is not declared to be a missing value.
    curve("", "with lines lw 1 dt 3");
    curve(fmt::format(" && ${} <= 0", stability), "with lines lw 2");
    curve("", "with points pt 7 ps 0.3");
  }
  // Bifurcation points have null vectors, limit points have none.
  script += fmt::format(
      "'points.csv' skip 1 using {0}:($7 > 0 ? $4 : NaN) with points pt 5 ps 1 lc rgb 'black', \\\n"
      "  '' skip 1 using {0}:(strcol(5) eq 'maximum' || strcol(5) eq 'minimum' ? $4 : NaN) with points pt 6 "
      "ps 1.2 lc rgb 'black'\n",
      pointColumn);
  return script;
}

/// Runs gnuplot on path.gp in the folder, whatever that is called: without a shell, and without start-up
/// files. Returns an empty text, or why there is no picture.
std::string draw(const std::string& directory) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  for (const int told : {1, 2}) posix_spawn_file_actions_addopen(&actions, told, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  std::string words[] = {"gnuplot", "--default-settings", "path.gp"};
  char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return "path.png not drawn: gnuplot is not installed (path.gp draws it)";
  if (error != 0) return "path.png not drawn: gnuplot could not be started";
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return "path.png not drawn: gnuplot's end is not known";
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return "path.png not drawn: gnuplot failed (see path.gp)";
  return "";
}

}  // namespace

std::string plotPath(const std::string& directory, const std::string& title,
                     const std::vector<std::string>& monitors, int branches) {
  if (!ranks::isFirst()) return "";
  const int plots = std::max<int>(1, static_cast<int>(monitors.size()));
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(plots))));
  const int rows = (plots + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans,11'\nset output 'path.png'\n"
      "set encoding utf8\nset datafile separator ','\nset grid\nset key off\n"
      "set multiplot layout {},{} title {}\nset ylabel 'load factor'\n",
      480 * columns, 400 * rows + 40, rows, columns, quoted(title));
  const int stability = 4 + static_cast<int>(monitors.size());
  if (monitors.empty()) script += panel("path length", 2, 3, stability, branches);
  for (int m = 0; m < static_cast<int>(monitors.size()); ++m)
    script += panel(monitors[m], 4 + m, 9 + m, stability, branches);
  script += "unset multiplot\n";
  replaceFile(directory + "/path.gp", script);

  return draw(directory);
}

}  // namespace atrapos
