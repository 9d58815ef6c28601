#include <algorithm>

#include "burin/common/memory_check.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/node/reference.hpp"
#include "burin/node/survey.hpp"
#include "burin/node/thread_share.hpp"

namespace burin::host {

namespace {

/// Rows dealt to the ranks in blocks by turns: neighbouring rows cost about the same.
class RowShare {
 public:
  static constexpr int kBlockRows = 8;
  RowShare(int height, int ranks, bool dedicatedHost)
      : height_{height}, first_{dedicatedHost ? 1 : 0}, drawing_{ranks - first_} {}

  std::vector<int> firstRows(int rank) const {
    std::vector<int> rows;
    if (rank < first_) return rows;
    for (int row = (rank - first_) * kBlockRows; row < height_; row += drawing_ * kBlockRows)
      rows.push_back(row);
    return rows;
  }
  int lastRow(int firstRow) const { return std::min(firstRow + kBlockRows, height_); }
  int rowCount(int rank) const {
    int count = 0;
    for (const int row : firstRows(rank)) count += lastRow(row) - row;
    return count;
  }

 private:
  int height_, first_, drawing_;
};

class ReferenceFrames : public FrameMaker {
 public:
  ReferenceFrames(const Communicator& comm, PreparedScene& prepared, bool dedicatedHost,
                  ReportProgress report)
      : comm_{comm},
        dedicatedHost_{dedicatedHost},
        threads_{node::threadShare(comm, !(dedicatedHost && comm.isRoot()))},
        report_{std::move(report)},
        source_{*prepared.source},
        labels_{prepared.labels.get()} {
    update(prepared.scene);
  }

  void update(const Scene& scene) final {
    // The survey's percentile, as the renderer uses it: the two are made to be compared.
    node::ReferenceScales scales;
    const node::SurveyRequest request{gradientOperatorsNeeded(scene), laplacianNeeded(scene)};
    if (!request.gradients.empty() || request.laplacian)
      scales = node::surveyedScales(node::surveyVolume(comm_, source_, request), scene);
    const std::size_t labelBytes = labelsNeeded(scene) ? labels_->info().bytes() : 0;
    checkMemory(comm_, {static_cast<std::int64_t>(source_.info().bytes() + labelBytes),
                        "the volume, whole on every rank for --reference,"});
    collectively(comm_, "loading the volume",
                 [&] { renderer_.emplace(scene, source_, scales, labels_); });
  }

  ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) override {
    const RowShare share{camera.image.height, comm_.size(), dedicatedHost_};
    std::vector<Rgba> mine;
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases, Phase::kDraw};
      drawing = attempt([&] { mine = drawRows(camera, share); });
    }
    const PhaseTimer timer{statistics.phases, Phase::kGather};
    agree(comm_, "drawing", std::move(drawing));
    frame_ = gather(camera.image, share, mine);
    return frame_;
  }

 private:
  /// All of this rank's rows; after an interrupt the rest of them empty, as the frame is dropped.
  std::vector<Rgba> drawRows(const Camera& camera, const RowShare& share) const {
    const int rank = static_cast<int>(comm_.rank());
    const std::vector<int> firstRows = share.firstRows(rank);
    std::vector<Rgba> pixels;
    double done = 0;
    for (const int row : firstRows) {
      if (interruptSignal() != 0) break;
      for (const glm::dvec4& c : renderer_->render(camera, row, share.lastRow(row), threads_)) {
        pixels.push_back({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b),
                          static_cast<float>(c.a)});
      }
      report_(++done / static_cast<double>(firstRows.size()));
    }
    pixels.resize(static_cast<std::size_t>(camera.image.width) *
                  static_cast<std::size_t>(share.rowCount(rank)));
    return pixels;
  }

  Image<Rgba> gather(ImageSize size, const RowShare& share, const std::vector<Rgba>& mine) const {
    std::vector<int> counts, offsets;
    for (int rank = 0; rank < comm_.size(); ++rank) {
      offsets.push_back(rank == 0 ? 0 : offsets.back() + counts.back());
      counts.push_back(share.rowCount(rank));
    }
    // Counted in rows, so that a large picture stays within MPI's int.
    MPI_Datatype rowType = MPI_DATATYPE_NULL;
    checkMpi(MPI_Type_contiguous(4 * size.width, MPI_FLOAT, &rowType), "MPI_Type_contiguous");
    checkMpi(MPI_Type_commit(&rowType), "MPI_Type_commit");
    Image<Rgba> dealt{comm_.isRoot() ? size : ImageSize{}};
    MPI_Request request = MPI_REQUEST_NULL;
    checkMpi(MPI_Igatherv(mine.data(), counts[static_cast<std::size_t>(comm_.rank())], rowType,
                          dealt.pixels().data(), counts.data(), offsets.data(), rowType, 0,
                          comm_.get(), &request),
             "MPI_Igatherv");
    waitIdle(request, "the reference's rows");
    MPI_Type_free(&rowType);
    return comm_.isRoot() ? inOrder(dealt, share) : Image<Rgba>{};
  }

  /// Rows in picture order from rows rank by rank.
  Image<Rgba> inOrder(const Image<Rgba>& dealt, const RowShare& share) const {
    Image<Rgba> image{dealt.size()};
    int from = 0;
    for (int rank = 0; rank < comm_.size(); ++rank) {
      for (const int first : share.firstRows(rank)) {
        for (int row = first; row < share.lastRow(first); ++row)
          std::ranges::copy(dealt.row(from++), image.row(row).begin());
      }
    }
    return image;
  }

  const Communicator& comm_;
  bool dedicatedHost_;
  int threads_;
  ReportProgress report_;
  node::BrickSource& source_;
  node::BrickSource* labels_;
  std::optional<node::ReferenceRenderer> renderer_;
  Image<Rgba> frame_;
};

}  // namespace

std::unique_ptr<FrameMaker> makeReferenceFrames(const Communicator& comm, PreparedScene& prepared,
                                                const node::WorkerOptions& options,
                                                ReportProgress report) {
  return std::make_unique<ReferenceFrames>(comm, prepared, options.dedicatedHost,
                                           std::move(report));
}

}  // namespace burin::host
