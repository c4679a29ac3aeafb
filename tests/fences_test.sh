#!/usr/bin/env bash
# A fence that lets everything through is no fence: one breach of each kind must be found.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

expect_breach() {
  local file=$1 line=$2
  mkdir -p "$tree"/{core,proto,server,clients} "$tree/$(dirname "$file")"
  : >"$tree/${file%.*}.hpp"
  printf '%s\n' "$line" >"$tree/$file"
  if ! grep -q ' rules broken$' <<<"$("$here/fences.sh" "$tree")"; then
    echo "not found: '$line' in $file"
    exit 1
  fi
  rm -r "${tree:?}"/*
}

expect_breach core/plan/plan.cpp '#include "server/jobs.hpp"'
expect_breach core/base/watch.hpp '#include <boost/asio.hpp>'
expect_breach proto/json.hpp '#include "core/base/error.hpp"'
expect_breach clients/cpp/client.cpp '#include "core/base/sha256.hpp"'
expect_breach clients/cli/main.cpp '#include "server/base/config.hpp"'
expect_breach server/main.cpp '#include "clients/cpp/client.hpp"'
expect_breach core/material/octree.cpp '#include "core/search/heuristic.hpp"'
for folder in base material cell collision search; do
  expect_breach "core/$folder/voxel.cpp" '#include "core/sweep/pass.hpp"'
  expect_breach "core/$folder/voxel.cpp" '#include "core/trajectory/keyframe.hpp"'
done
for later in collision search motion sweep verify plan; do
  expect_breach core/trajectory/reader.cpp "#include \"core/$later/scene.hpp\""
done
expect_breach core/motion/arm.cpp '#include "core/sweep/hub_arm.hpp"'
expect_breach core/motion/arm.cpp '#include "core/verify/verify.hpp"'
expect_breach core/motion/arm.cpp '#include "core/trajectory/writer.hpp"'
expect_breach core/sweep/sweep.cpp '#include "core/trajectory/reader.hpp"'
expect_breach core/sweep/sweep.cpp '#include "core/verify/findings/findings.hpp"'
expect_breach core/sweep/sweep.cpp '#include "core/doctor/examine.hpp"'
expect_breach core/plan/plan.cpp '#include "core/doctor/examine.hpp"'
expect_breach core/verify/timed/check_motion.cpp '#include "core/timing/motion/sampler.hpp"'
expect_breach core/timing/corners.cpp '#include "core/sweep/follow.hpp"'
expect_breach core/program/read/part_reader.cpp '#include "core/program/write/number_format.hpp"'
expect_breach core/program/write/krl.cpp '#include "core/program/read/part_reader.hpp"'
expect_breach core/verify/verify.cpp '#include "core/program/dialect.hpp"'
expect_breach core/law/law_file.cpp '#include "core/timing/corners.hpp"'
expect_breach core/place/place.cpp '#include "core/verify/verify.hpp"'
expect_breach core/verify/verify.cpp '#include "core/doctor/examine.hpp"'
expect_breach core/motion/arm.cpp '#include "core/cell/cell_field.hpp"'
expect_breach core/motion/arm.cpp '#include "core/cell/cell_motion.hpp"'
expect_breach core/doctor/draw_cell.cpp '#include <png.h>'
expect_breach core/verify/replay.cpp '  #  include "core/motion/transit.hpp"'
expect_breach core/verify/robot/checked_pairs.cpp '#include "core/collision/link_pairs.hpp"'
expect_breach core/verify/cut_log.cpp '#include "core/material/support/support.hpp"'
expect_breach core/verify/cut_log.cpp '#include "core/material/loose_pieces.hpp"'
expect_breach core/verify/verify.cpp '#include <tinyxml2.h>'
expect_breach core/solid/voxelize.cpp '#include <assimp/scene.h>'
expect_breach core/cell/chain.cpp '#include <urdf_parser/urdf_parser.h>'
expect_breach core/motion/transit.cpp '#include <fcl/fcl.h>'
expect_breach core/collision/scene.cpp '#include <ompl/base/SpaceInformation.h>'
expect_breach core/plan/plan.cpp '#include <nlohmann/json.hpp>'
expect_breach core/trajectory/reader.hpp '#include <nlohmann/json.hpp>'
expect_breach core/collision/scene.hpp 'std::unique_ptr<fcl::CollisionObjectd> object_;'
expect_breach core/motion/transit.cpp '#include "core/collision/shape/fcl_shape.hpp"'
expect_breach server/confine/confinement.cpp '#include <seccomp.h>'
expect_breach server/net/session.cpp '#include "server/api/handlers.hpp"'
expect_breach server/base/config.cpp '#include "server/store/sqlite.hpp"'
expect_breach server/store/sqlite.cpp '#include "server/server.hpp"'
expect_breach server/run/planner.cpp '#include "core/verify/robot/solid_body.hpp"'
# Each folder sees nothing of the next one in its order.
eval "$(grep -E '^(core|server)_folders=' "$here/fences.sh")"
for ((i = 0; i + 1 < ${#core_folders[@]}; ++i)); do
  expect_breach "core/${core_folders[i]}/any.cpp" "#include \"core/${core_folders[i + 1]}/any.hpp\""
done
for ((i = 0; i + 1 < ${#server_folders[@]}; ++i)); do
  expect_breach "server/${server_folders[i]}/any.cpp" "#include \"server/${server_folders[i + 1]}/any.hpp\""
done
expect_breach proto/json.hpp '#include <boost/asio.hpp>'
expect_breach core/material/voxel_grid.hpp '#include "core/mesh/mesh.hpp"'
expect_breach core/sweep/lanes.cpp '#include <hwy/highway.h>'
expect_breach server/store/job_store.cpp '#include <libpq-fe.h>'
expect_breach core/verify/robot/joint_range.cpp '#include "core/cell/chain.hpp"'
expect_breach core/verify/robot/joint_range.cpp '#include "core/cell/ik.hpp"'
expect_breach core/verify/verify.cpp '#include "core/solid/voxelize.hpp"'
expect_breach core/verify/verify.cpp 'const Chain& chain = cell.chain();'
expect_breach core/verify/robot/urdf_differences.cpp 'for (const Shape& shape : holder_shapes(cell.tool))'
expect_breach core/lathe/turn.cpp '// A folder that nobody gave a rule.'
expect_breach server/lathe/turn.cpp '// A folder that nobody gave a rule.'
mkdir -p "$tree"/{core/plan,proto,server/ops,clients}
printf 'int what;\n' >"$tree/server/ops/what.cpp"
if ! grep -q ' rules broken$' <<<"$("$here/fences.sh" "$tree")"; then echo "not found: a file that does not say what it is" && exit 1; fi
rm "$tree/server/ops/what.cpp"
printf '// A plan.\n#include "core/base/error.hpp"\n' >"$tree/core/plan/plan.cpp"
"$here/fences.sh" "$tree"
