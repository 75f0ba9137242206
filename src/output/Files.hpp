#pragma once

#include <optional>
#include <string>
#include <vector>

namespace atrapos {

/// Replaces a file whole or not at all: writes beside it and renames. Throws FileError.
void replaceFile(const std::string& file, const std::string& content);

/// The branch whose fields a file of this name holds, 0 for results.exo; empty: it is another file.
std::optional<int> branchOfFields(const std::string& name);

/// The file of a branch's tools, tools.exo for branch 0, and whether a file's name is such a one.
std::string toolsName(int branch);
bool isToolsName(const std::string& name);

/// Whether runs write files of this name into their folder.
bool isResultName(const std::string& name);

/// What a file was made as.
enum class Made { mesh, map, chart, result, report };

/// Throws std::invalid_argument, one line, where the file is there and may not be replaced: it is not a
/// regular one, it is one of `inputs`, or it does not look as if this program had made it as the same.
void requireOwn(const std::string& file, Made as, const std::vector<std::string>& inputs);

/// The same of NAME.gp, NAME.png and NAME.svg: the script tells who made them.
void requireOwnPicture(const std::string& name);

/// Makes the folder where it is missing. Throws std::invalid_argument, one line, where no file can be made in
/// it, or a run may not replace what has the name of a result there (requireOwn); changes nothing that is in
/// it.
void prepareFolder(const std::string& folder, const std::vector<std::string>& inputs);

}  // namespace atrapos
