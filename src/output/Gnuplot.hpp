#pragma once

#include <string>

namespace atrapos {

/// A text from a deck, or a file's name, as a string of gnuplot that is nothing but this text: one line, with
/// blanks for control characters, cut after 120 characters.
std::string gnuplotText(const std::string& text);

/// Runs gnuplot on a script in a folder, whatever that is called: without a shell, and without start-up
/// files. Returns an empty text, or why there is no picture.
std::string runGnuplot(const std::string& folder, const std::string& script);

}  // namespace atrapos
