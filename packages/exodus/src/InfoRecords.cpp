#include "atrapos/exodus/InfoRecords.hpp"

#include <sstream>

namespace atrapos::exodus {

namespace {

constexpr std::size_t maxLength = 80;
constexpr char continued = '\\';

bool goesOn(const std::string& record) { return record.size() == maxLength && record.back() == continued; }

void append(std::string line, std::vector<std::string>& records) {
  while (line.size() > maxLength || goesOn(line)) {
    records.push_back(line.substr(0, maxLength - 1) + continued);
    line.erase(0, maxLength - 1);
  }
  records.push_back(line);
}

}  // namespace

std::vector<std::string> toInfoRecords(const std::vector<std::string>& lines) {
  std::vector<std::string> records;
  for (const std::string& text : lines) {
    if (text.empty()) records.emplace_back();
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) append(line, records);
  }
  return records;
}

std::vector<std::string> fromInfoRecords(const std::vector<std::string>& records) {
  std::vector<std::string> lines;
  std::string line;
  bool open = false;
  for (const std::string& record : records) {
    open = goesOn(record);
    line += open ? record.substr(0, maxLength - 1) : record;
    if (open) continue;
    lines.push_back(line);
    line.clear();
  }
  if (open) lines.push_back(line);
  return lines;
}

}  // namespace atrapos::exodus
