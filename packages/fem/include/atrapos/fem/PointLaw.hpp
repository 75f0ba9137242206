#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/taylor/Context.hpp"

namespace atrapos::fem {

/// Entities of a batch: their numbers lie side by side, [...][lane], the same on every machine. Laws and
/// loops work through them in as many lanes at a time as a register holds.
constexpr int kLanes = 8;

/// Points that a law works on in one call: those of a batch of entities.
struct PointBatch {
  int numPoints = 0;             ///< of each entity
  int lanes = 0;                 ///< entities there are, 1..kLanes; what the others hold does not matter
  const double* data = nullptr;  ///< [point][datum][lane]
  double* memory = nullptr;      ///< what each call says; aligned to 16 bytes
};

/// Order k of series of orders up to maxOrder, with what all points share.
struct SeriesOrder {
  int k = 0, maxOrder = 0;
  taylor::OrderBlock block;
  int waiting = 0;
};
/// k = 0 (start) to maxOrder.
SeriesOrder seriesOrder(int k, int maxOrder);

/// A point where a law has no Taylor series.
struct PointFailure {
  int lane = -1, point = 0;  ///< -1: none
  taylor::Operation operation = taylor::Operation::None;
  double value = 0;
};

/// What a law (taylor/Law.hpp) is to element loops. All arrays are [point][entry][lane].
struct LawShape {
  int inputs = 0, outputs = 0;
  int data = 0;            ///< passive numbers a point
  bool symmetric = false;  ///< d out/d in is
  int observed = 0;        ///< named values
  int variables = 0;       ///< internal variables: the last data, and the last outputs
  /// 1 where a point of the law is either free or active, as its first datum, 0 or 1, says, and changes at
  /// events: the output in front of the variables, dimensionless and of size 1, is not negative at a free
  /// point while it is free, and never falls along the path at an active one while it is active.
  int events = 0;
  bool sizes = false;  ///< outputs have sizes of their own (PointLaw::sizes)
  /// With events, of a law that is smooth but for the sense of its path: the function never falls at a free
  /// point either, and of an active one it is minus the share of flow that it would have if it were free.
  /// Where that is next to nothing a point may be either.
  bool freeGrow = false;
};

/// A law in batches of points: compiled once, whatever loops it stands in. Virtual once a batch.
class PointLaw {
 public:
  virtual ~PointLaw() = default;

  virtual LawShape shape() const = 0;
  /// Doubles that the series of kLanes points keep; with maxOrder = 0 what `value`, the tangents and `carry`
  /// need as scratch memory, once for all points.
  std::size_t historyDoubles(int maxOrder) const { return seriesDoubles(seriesOrder(0, maxOrder)); }
  /// The same for series of these orders.
  virtual std::size_t seriesDoubles(const SeriesOrder& order) const = 0;

  /// out = law(in). memory: historyDoubles(0) of scratch.
  virtual void value(const PointBatch& points, const double* in, double* out) const = 0;
  /// The same and jacobian [point][output][input][lane].
  virtual void tangent(const PointBatch& points, const double* in, double* out, double* jacobian) const = 0;
  /// The same by one input alone: derivative [point][output][lane].
  virtual void derivative(const PointBatch& points, int input, const double* in, double* out,
                          double* derivative) const = 0;

  /// Order 0 of a series. memory: numPoints times historyDoubles(maxOrder), kept from order to order. Notes
  /// the first point without a series.
  virtual void start(const PointBatch& points, const SeriesOrder& order, const double* in, double* out,
                     PointFailure& failure) const = 0;
  /// Makes order k - 1 that of the inputs `last` (not read for k = 1), then out = order k with coefficient k
  /// of the inputs taken as zero: in one visit, so that histories are read from memory once an order.
  void order(const PointBatch& points, const SeriesOrder& order, const double* last, double* out) const {
    advance(points, order, {last, nullptr}, {nullptr, out});
  }

  /// Inputs and outputs of two orders.
  struct In {
    const double* last;     ///< order k - 1: what was not given when it was the order under way
    const double* current;  ///< order k, as much as is known of it; null: nothing
  };
  struct Out {
    double* last;     ///< the linear effect of In::last; null: not wanted
    double* current;  ///< order k; null: no more orders are wanted
  };
  /// The same for a law that stands behind others (stagedLaw), whose inputs of order k are known in part.
  /// Only laws that are made for it (`static constexpr bool stage = true`) take `current`; these and laws
  /// with internal variables give `last` and do without an order k. A stage may have internal variables.
  virtual void advance(const PointBatch& points, const SeriesOrder& order, In in, Out out) const = 0;

  /// The internal variables at `to`, [point][variable][lane], of those that the data hold at `from`: along
  /// the straight line between these inputs. memory: historyDoubles(0) of scratch. Laws without variables
  /// have no use for it.
  virtual void carry(const PointBatch& points, const double* from, const double* to, double* variables,
                     PointFailure& failure) const;

  /// Sizes of what the outputs are sums of, in their shape: an output that cancels at the point, as source
  /// and sink do, has one of rounding, against which no residual is small. Of laws with LawShape::sizes; all
  /// others throw std::logic_error, for their outputs are their sizes.
  virtual void sizes(const PointBatch& points, const double* in, double* out) const;

  /// Names of the values that the law shows at its points.
  virtual std::vector<std::string> observedNames() const = 0;
  /// These values at all points of a batch: [point][name][lane]. memory: historyDoubles(0) of scratch.
  virtual void observe(const PointBatch& points, const double* in, double* values) const = 0;
  /// Whether there is something for the law to act on at a point with these data (patches: whether it is over
  /// one).
  virtual bool exists(const double* data) const = 0;
};

/// The law in batches. Defined for a law in PointLawOf.hpp; laws of the packages are compiled there, for
/// every instruction set that the program is for, and their headers say so (ATRAPOS_DECLARE_POINT_LAW).
template <class Law>
std::unique_ptr<PointLaw> pointLaw(const Law& law);

}  // namespace atrapos::fem

/// In the header of a law whose source has ATRAPOS_POINT_LAW; outside of namespaces.
#define ATRAPOS_DECLARE_POINT_LAW(...) \
  extern template std::unique_ptr<atrapos::fem::PointLaw> atrapos::fem::pointLaw(const __VA_ARGS__&);
