#include "Cases.hpp"
#include "JobFactory.hpp"

namespace atrapos::bench {

void addJobsAlone(const Selection& selection, std::vector<Job>& jobs) {
  forEachAlone(JobFactory(selection, jobs));
}

}  // namespace atrapos::bench
