#include "output/Gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <iterator>

#include "deck/Characters.hpp"

extern char** environ;

namespace atrapos {
namespace {

/// So many characters of a text in UTF-8.
std::string firstOf(const std::string& text, int count) {
  std::size_t end = 0;
  for (; end < text.size() && count > 0; --count) end += deck::characterSize(text, end);
  return end < text.size() ? text.substr(0, end) + "..." : text;
}

}  // namespace

// Gnuplot runs what is between backticks wherever no single quote is open, puts in what @ names, and loses
// count of quotes within quotes: all that may mean something is written as its octal number.
std::string gnuplotText(const std::string& text) {
  constexpr int longest = 120;  // wider than the picture
  std::string result = "\"";
  bool number = false;  // a digit would go on with it
  for (const char c : firstOf(deck::plainLine(text), longest)) {
    const auto code = static_cast<unsigned char>(c);
    const bool letter = (code >= 'a' && code <= 'z') || (code >= 'A' && code <= 'Z');
    const bool digit = code >= '0' && code <= '9';
    if (letter || (digit && !number) || std::strchr(" .,:;()+-*/=_", c)) {
      result += c;
      number = false;
    } else {
      result += fmt::format("\\{:03o}", code);
      number = true;
    }
  }
  return result + '"';
}

const char* plotColour(std::size_t i) {
  static const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#e69f00", "#56b4e9", "#444444", "#8c510a"};
  return colours[i % std::size(colours)];
}

std::string pictureHead(const std::string& file, const std::string& title) {
  return fmt::format(
      "reset\nset encoding utf8\nset output {}\nset multiplot title {}\nset grid lw 0.7 lc rgb '#c9d2d9' "
      "dt 1\n"
      "set border lc rgb '#5a6872'\nset tics textcolor rgb '#111111'\nset key off\n",
      gnuplotText(file), gnuplotText(title));
}

std::string pictureScript(const std::string& name, int width, int height, const std::string& data,
                          const std::function<std::string(const std::string& file)>& draw) {
  return fmt::format(
             "set terminal pngcairo noenhanced size {},{} font 'sans,11' fontscale 2 linewidth 2 "
             "pointscale 2\n",
             2 * width, 2 * height) +
         data + draw(name + ".png") +
         fmt::format("set terminal svg noenhanced size {},{} font 'sans,12' background 'white'\n", width,
                     height) +
         draw(name + ".svg");
}

std::string runGnuplot(const std::string& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  for (const int told : {1, 2}) posix_spawn_file_actions_addopen(&actions, told, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string words[] = {"gnuplot", "--default-settings", script};
  char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return fmt::format("gnuplot is not installed ({} draws it)", script);
  if (error != 0) return "gnuplot could not be started";
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return "gnuplot's end is not known";
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return fmt::format("gnuplot failed (see {})", script);
  return "";
}

}  // namespace atrapos
