#include "bench/max_error_measurement.hpp"

#include <algorithm>
#include <memory>

#include "bench/converged_picture.hpp"
#include "bench/picture_error.hpp"
#include "burin/common/error.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/node/survey.hpp"
#include "step_choice.hpp"

namespace burin::host::bench {

namespace {

using Row = MaxErrorMeasurement;

/// A volume with one transfer function, in all views.
class Views {
 public:
  Views(const Communicator& comm, PreparedScene& prepared, const MaxErrorPlan& plan)
      : comm_{comm}, prepared_{prepared} {
    for (const View& view : plan.views) {
      prepared.scene.camera.azimuthDeg = view.azimuthDeg;
      prepared.scene.camera.elevationDeg = view.elevationDeg;
      cameras_.push_back(resolveCamera(prepared.scene, prepared.facts));
    }
    const double allowed = plan.truthPart * std::ranges::min(plan.asked);
    truths_ = truths(allowed);
    const auto closer = truths(allowed / 2);
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      changes_.push_back(comm.isRoot() ? pictureError(truths_[i], closer[i]).largest : 0);
  }

  double truthChange(std::size_t view) const { return changes_[view]; }

  struct Drawn {
    double error = 0;  ///< the same on every rank
    std::int64_t samples = 0;
  };
  /// Collective. Every view with this quality.
  std::vector<Drawn> draw(const Quality& quality) {
    prepared_.scene.quality = quality;
    const auto frames = makeRaycastFrames(comm_, prepared_, {.countSamples = true}, {});
    std::vector<Drawn> all;
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      RankStatistics counted;
      const ImageView<const Rgba> frame = frames->make(cameras_[i], counted);
      Drawn& drawn = all.emplace_back();
      if (comm_.isRoot()) drawn.error = pictureError(frame, truths_[i]).largest;
      allReduce(comm_, std::span{&drawn.error, 1}, MPI_MAX);
      drawn.samples = counted.samplesVisited;
      allReduce(comm_, std::span{&drawn.samples, 1}, MPI_SUM);
    }
    return all;
  }

 private:
  std::vector<Image<Rgba>> truths(double allowed) {
    std::vector<Image<Rgba>> pictures;
    for (const Camera& camera : cameras_)
      pictures.push_back(convergedPicture(comm_, prepared_, allowed, camera));
    return pictures;
  }

  const Communicator& comm_;
  PreparedScene& prepared_;
  std::vector<Camera> cameras_;
  std::vector<Image<Rgba>> truths_;
  std::vector<double> changes_;
};

/// Collective. Ever smaller fixed steps until each of the rows, one per view, has both its steps.
void compareWithFixedSteps(Views& views, std::span<Row> rows, double smallestStep) {
  const double asked = rows.front().asked;
  const auto isOpen = [](const Row& row) { return !row.asGood || !row.asAsked; };
  for (double step = kLargestChosenStep; step >= smallestStep && std::ranges::any_of(rows, isOpen);
       step /= 2) {
    const auto drawn = views.draw({step, terminationOf(asked), true, {}});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const FixedStep fixed{step, drawn[i].samples};
      if (!rows[i].asGood && drawn[i].error <= rows[i].errorMax) rows[i].asGood = fixed;
      if (!rows[i].asAsked && drawn[i].error <= asked) rows[i].asAsked = fixed;
    }
  }
}

}  // namespace

TransferFunction maxErrorFunction(std::string_view name, double lowest, double highest) {
  TransferFunction function;
  const auto add = [&](double part, const Colour& colour, double opacity) {
    function.points.push_back({lowest + part * (highest - lowest), colour, opacity});
  };
  const auto addPeak = [&](double from, double to, const Colour& colour, double opacity) {
    add(from, colour, 0);
    add((from + to) / 2, colour, opacity);
    add(to, colour, 0);
  };
  if (name == "smooth") {
    add(0.15, {32, 48, 128}, 0);
    add(0.35, {208, 160, 128}, 0.05);
    add(0.55, {240, 224, 192}, 0.3);
    add(0.8, {255, 255, 255}, 0.8);
  } else {
    BURIN_CHECK(name == "spiky");
    addPeak(0.2, 0.21, {192, 64, 32}, 0.6);
    addPeak(0.45, 0.454, {48, 160, 80}, 0.9);
    addPeak(0.7, 0.72, {64, 96, 208}, 0.5);
  }
  return function;
}

std::vector<Row> measureMaxError(const Communicator& comm, NamedScene& named,
                                 const MaxErrorPlan& plan) {
  PreparedScene& prepared = named.prepared;
  prepared.scene.imageSize = {plan.side, plan.side};
  const node::VolumeSurvey survey = node::surveyVolume(comm, *prepared.source, {});
  std::vector<Row> rows;
  for (const std::string_view function : {"smooth", "spiky"}) {
    Layer layer;
    layer.name = function;
    layer.transferFunction = maxErrorFunction(function, survey.lowest, survey.highest);
    prepared.scene.layers = {layer};
    resolveScene(prepared.scene, prepared.facts);
    Views views{comm, prepared, plan};
    for (const double asked : plan.asked) {
      Quality quality;
      quality.maxError = asked;
      const auto drawn = views.draw(quality);
      const std::size_t first = rows.size();
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        Row& row = rows.emplace_back();
        row.volume = named.name;
        row.function = function;
        row.azimuthDeg = plan.views[i].azimuthDeg;
        row.elevationDeg = plan.views[i].elevationDeg;
        row.asked = asked;
        row.errorMax = drawn[i].error;
        row.samples = drawn[i].samples;
        row.truthChange = views.truthChange(i);
      }
      compareWithFixedSteps(views, std::span{rows}.subspan(first), plan.smallestStep);
    }
  }
  return rows;
}

}  // namespace burin::host::bench
