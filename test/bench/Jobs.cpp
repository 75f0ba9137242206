#include "Jobs.hpp"

#include "Cases.hpp"
#include "JobFactory.hpp"

namespace atrapos::bench {

std::vector<std::string> methodNames() {
  return {"sacado",  "sacado_oneshot",
#ifdef ATRAPOS_BENCH_ADOLC
          "adolc",   "adolc_oneshot",
#endif
          "atrapos", "atrapos_closed", "hand", "hand_blocked"};
}

std::vector<std::string> lawNames() {
  std::vector<std::string> names;
  forEachCase([&](const char* name, const auto&, const auto&, const Domain&) { names.push_back(name); });
  forEachAlone([&](const char* name, const auto&, const Domain&) { names.push_back(name); });
  return names;
}

std::vector<Job> makeJobs(const Selection& selection) {
  std::vector<Job> jobs;
  forEachCase(JobFactory(selection, jobs));
  addJobsAlone(selection, jobs);
  return jobs;
}

}  // namespace atrapos::bench
