#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "AtraposSweep.hpp"
#include "HandSweep.hpp"
#include "Jobs.hpp"
#include "Laws.hpp"
#include "OperationCount.hpp"
#include "SacadoPeer.hpp"
#ifdef ATRAPOS_BENCH_ADOLC
#include "AdolcPeer.hpp"
#endif

namespace atrapos::bench {

inline bool has(const std::vector<std::string>& chosen, const std::string& name) {
  return chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
}

/// Outputs of 64 points, overwritten again and again: an element loop scatters them at once, too.
template <int O>
struct Outputs {
  using Pack = taylor::Lanes<kLanes>;
  Pack values[kDistinctBatches][O];
  Pack* operator()(int, std::size_t b) { return values[b % kDistinctBatches]; }
};

/// Peers' outputs: adding them up is enough to have them computed.
struct Total {
  double sum = 0;
  void operator()(int, std::size_t, int, double c) { sum += c; }
};

/// Jobs of laws with their methods, for forEachCase and forEachAlone.
class JobFactory {
 public:
  JobFactory(const Selection& selection, std::vector<Job>& jobs) : selection_(selection), jobs_(jobs) {}

  template <class Law, class PeerLaw>
  void operator()(const char* name, const Law& law, const PeerLaw& peerLaw, const Domain& domain) const {
    if (!has(selection_.laws, name)) return;
    for (int order : selection_.orders) {
      const auto inputs = std::make_shared<const Inputs>(domain, order);
      Row row;
      row.law = name;
      row.order = order;
      row.usefulFlops = usefulFlops(peerLaw, order);
      addPeer<PeerLaw>(row, "sacado", inputs, std::make_shared<SacadoPeer<PeerLaw>>(peerLaw, order));
#ifdef ATRAPOS_BENCH_ADOLC
      if (has(selection_.methods, "adolc") || has(selection_.methods, "adolc_oneshot"))
        addPeer<PeerLaw>(row, "adolc", inputs,
                         std::make_shared<AdolcPeer<PeerLaw>>(peerLaw, order, nextTag(), *inputs));
#endif
      for (std::size_t points : selection_.points) {
        addSweep<Law::numOutputs>(row, "atrapos", points, inputs,
                                  std::make_shared<AtraposSweep<Law>>(law, order));
        if constexpr (!std::is_same_v<Law, PeerLaw>)
          addSweep<Law::numOutputs>(row, "atrapos_closed", points, inputs,
                                    std::make_shared<AtraposSweep<PeerLaw>>(peerLaw, order));
        if constexpr (std::is_same_v<Law, solid::SaintVenantKirchhoff>)
          for (bool blocked : {false, true})
            addSweep<Law::numOutputs>(
                row, blocked ? "hand_blocked" : "hand", points, inputs,
                std::make_shared<HandSweep>(hand::Material{law.lambda, law.mu}, order, blocked));
      }
    }
  }

  template <class Law>
  void operator()(const char* name, const Law& law, const Domain& domain) const {
    if (!has(selection_.laws, name)) return;
    for (int order : selection_.orders) {
      Row row;
      row.law = name;
      row.order = order;
      row.usefulFlops = usefulFlops(law, order);
      const auto inputs = std::make_shared<const Inputs>(domain, order);
      for (std::size_t points : selection_.points)
        addSweep<Law::numOutputs>(row, "atrapos", points, inputs,
                                  std::make_shared<AtraposSweep<Law>>(law, order));
    }
  }

 private:
  template <int O, class S>
  void addSweep(Row row, const char* method, std::size_t points, const std::shared_ptr<const Inputs>& inputs,
                const std::shared_ptr<S>& sweep) const {
    if (!has(selection_.methods, method)) return;
    const std::size_t batches = points / kLanes;
    Job job;
    job.doubles = sweep->historyDoubles(batches);
    row.method = method;
    row.points = points;
    row.bytes = sweep->bytesPerPoint();
    row.footprint = 8.0 * job.doubles;
    row.boundApplies = true;
    job.row = row;
    const auto outputs = std::make_shared<Outputs<O>>();
    job.run = [=](double* history) {
      sweep->run(history, batches, *inputs, [&](int k, std::size_t b) { return (*outputs)(k, b); });
    };
    jobs_.push_back(std::move(job));
  }

  template <class Law, class Peer>
  void addPeer(Row row, const std::string& method, const std::shared_ptr<const Inputs>& inputs,
               const std::shared_ptr<Peer>& peer) const {
    row.points = std::max<std::size_t>(
        kDistinct, selection_.peerBytes / (8 * peer->seriesDoubles(1)) / kDistinct * kDistinct);
    const auto total = std::make_shared<Total>();
    const std::size_t points = row.points;
    Job job;
    job.slow = true;
    job.doubles = peer->seriesDoubles(points);
    row.footprint = 8.0 * job.doubles;
    if (has(selection_.methods, method)) {
      row.method = method;
      row.bytes = 8.0 * Law::numInputs;
      for (int k = 1; k <= row.order; ++k) row.bytes += 8.0 * Law::numInputs * (k + 2);
      job.row = row;
      job.run = [=](double* series) { peer->reevaluate(series, points, *inputs, std::ref(*total)); };
      jobs_.push_back(job);
    }
    if (has(selection_.methods, method + "_oneshot")) {
      row.method = method + "_oneshot";
      row.bytes = 2 * 8.0 * Law::numInputs * (row.order + 1);
      job.row = row;
      job.run = [=](double* series) { peer->oneShot(series, points, *inputs, std::ref(*total)); };
      jobs_.push_back(job);
    }
  }

  static short nextTag() {
    static short tag = 0;
    return ++tag;
  }

  const Selection& selection_;
  std::vector<Job>& jobs_;
};

/// Of the laws that are measured alone: a source of their own, as all laws in one take half a minute.
void addJobsAlone(const Selection& selection, std::vector<Job>& jobs);

}  // namespace atrapos::bench
