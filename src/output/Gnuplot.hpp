#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace atrapos {

/// A text from a deck, or a file's name, as a string of gnuplot that is nothing but this text: one line, with
/// blanks for control characters, cut after 120 characters.
std::string gnuplotText(const std::string& text);

/// Colours of curves, told apart by people who see fewer colours too (Okabe and Ito, "Color universal
/// design", 2008).
const char* plotColour(std::size_t i);

/// How every picture begins: its file, title, grid and border.
std::string pictureHead(const std::string& file, const std::string& title);

/// The script of NAME.png and NAME.svg: the data, then what `draw` makes for each file. Width and height are
/// those of the SVG; the PNG has twice as many pixels.
std::string pictureScript(const std::string& name, int width, int height, const std::string& data,
                          const std::function<std::string(const std::string& file)>& draw);

/// Runs gnuplot on a script in a folder, whatever that is called: without a shell, and without start-up
/// files. Returns an empty text, or why there is no picture.
std::string runGnuplot(const std::string& folder, const std::string& script);

}  // namespace atrapos
