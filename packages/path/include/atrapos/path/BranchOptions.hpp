#pragma once

namespace atrapos::path {

/// Which branches are followed where the path bifurcates.
enum class Follow {
  none,    ///< the first path only; bifurcation points are reported
  stable,  ///< branches whose tangent has no negative eigenvalue where they start
  all
};

struct BranchOptions {
  Follow follow = Follow::all;
  int maxDepth = 4;      ///< bifurcations between the first path and a branch, >= 0
  int maxBranches = 20;  ///< half-branches followed besides the first path, >= 0
};

}  // namespace atrapos::path
