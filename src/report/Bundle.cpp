#include "report/Bundle.hpp"

// The assembler takes the files as they are: as literals they would be compiled for long.
asm(".section .rodata\n"
    ".global atrapos_report_script, atrapos_report_script_end\n"
    "atrapos_report_script: .incbin \"" ATRAPOS_REPORT_FILES
    "/report.min.js\"\n"
    "atrapos_report_script_end: .byte 0\n"
    ".global atrapos_report_licences, atrapos_report_licences_end\n"
    "atrapos_report_licences: .incbin \"" ATRAPOS_REPORT_FILES
    "/LICENSES.txt\"\n"
    "atrapos_report_licences_end: .byte 0\n"
    ".previous\n");

extern "C" {
extern const char atrapos_report_script[], atrapos_report_script_end[];
extern const char atrapos_report_licences[], atrapos_report_licences_end[];
}

namespace atrapos::bundle {

std::string_view script() {
  return {atrapos_report_script, static_cast<std::size_t>(atrapos_report_script_end - atrapos_report_script)};
}

std::string_view licences() {
  return {atrapos_report_licences,
          static_cast<std::size_t>(atrapos_report_licences_end - atrapos_report_licences)};
}

}  // namespace atrapos::bundle
