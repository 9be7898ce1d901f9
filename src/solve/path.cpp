// SPDX-License-Identifier: Apache-2.0
#include "solve/path.h"

#include "solve/path_kernel.h"

namespace sconce {

namespace {

class PathSolver final : public Solver {
 public:
  PathSolver(const SolveContext& context, const BakeParams& params)
      : context_(context),
        params_(params),
        usual_(usual_light(context.world, context.tracer, context.lamps)) {}

  void solve(const Footprint& receiver, std::span<GroupValue> out) const override {
    PathKernel<Tracer> kernel(context_.scene, context_.world, context_.tracer, context_.lamps,
                              params_.bounces, context_.wanted, {}, usual_);
    solve_receiver(kernel, receiver, params_, out);
  }
  bool set_samples(int samples) override {
    params_.samples = samples;
    return true;
  }

 private:
  SolveContext context_;
  BakeParams params_;
  std::vector<double> usual_;  ///< usual_light()
};

}  // namespace

std::unique_ptr<Solver> make_path_solver(const SolveContext& context, const BakeParams& params,
                                         const Progress&) {
  return std::make_unique<PathSolver>(context, params);
}

}  // namespace sconce
