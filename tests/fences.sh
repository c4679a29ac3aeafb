#!/usr/bin/env bash
# The include rules: who may see whom, and which one file is the door to each heavy library. Prints every breach; exit 0 only without one.
#   tests/fences.sh [FOLDER]      the source tree; default: the one this script is in
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
breaches=0

# forbid WHY PATTERN [EXCEPT-REGEX] -- PATHS...: no line of any C++ file under PATHS may match PATTERN, except in files whose name matches.
forbid() {
  local why=$1 pattern=$2 except='^$' path paths=() line found=()
  shift 2
  [ "$1" = -- ] || { except=$1; shift; }
  for path in "${@:2}"; do [ ! -e "$path" ] || paths+=("$path"); done
  ((${#paths[@]} > 0)) || return 0
  while read -r line; do
    [[ ${line%%:*} =~ $except ]] || found+=("$line")
  done < <(grep -rnsE --include='*.hpp' --include='*.cpp' -e "$pattern" -- "${paths[@]}" | sort)
  ((${#found[@]} == 0)) || { printf 'fence: %s\n' "$why" "${found[@]}"; breaches=$((breaches + 1)); }
}

include() { printf '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<](%s)' "$1"; }
door() { printf '^core/%s$' "$1"; }

# Layers.
forbid "core knows no server, wire or client" "$(include '(server|proto|clients)/')" -- core
forbid "core knows no socket, log or database" "$(include 'boost/(asio|beast)|spdlog|fmt/|sqlite3|sys/socket|netinet/')" -- core
forbid "proto knows no planner, server or client" "$(include '(core|server|clients)/')" -- proto
forbid "proto knows no socket, log or database" "$(include 'boost/|spdlog|sqlite3|sys/socket')" -- proto
forbid "the client library knows only proto" "$(include '(core|server|clients/cli)/')" -- clients/cpp
forbid "clients never include the server" "$(include 'server/')" -- clients
forbid "the server never includes a client" "$(include 'clients/')" -- server

# The data flow inside core: a folder sees only what stands before it, and search and collision nothing of some of that.
core_folders=(base mesh material solid cell trajectory law verify picture collision search motion sweep mill doctor place timing program plan)
for ((i = 0; i + 1 < ${#core_folders[@]}; ++i)); do
  above=$(IFS='|' && echo "${core_folders[*]:i+1}")
  forbid "core/${core_folders[i]} stands before ${above//|/, }" "$(include "core/($above)/")" -- "core/${core_folders[i]}"
done
forbid "voxels know no mesh" "$(include 'core/mesh/')" -- core/material
forbid "collision knows no trajectory" "$(include 'core/(trajectory|picture)/')" -- core/collision
forbid "search knows no arm" "$(include 'core/(cell|trajectory|collision)/')" -- core/search
forbid "planners know keyframes, not how a file of them is read or written" \
  "$(include 'core/trajectory/(binary/|text/|export|form|header|reader|trajectory_|writer)')" -- core/motion core/sweep
forbid "time laws need no planner" "$(include 'core/(picture|search|motion|sweep|mill|doctor|place)/')" -- core/timing
forbid "what reads programs back shares nothing with what writes them" "$(include 'core/(program/(write|axis|make|program_move)|timing|cell)')" -- core/program/read
forbid "what writes programs knows no reader" "$(include 'core/program/read')" -- core/program/write
forbid "planners know nothing of the replay" "$(include 'core/verify/')" -- core/{picture,collision,search,motion,sweep,mill,place,timing,program}
forbid "plans need no doctor" "$(include 'core/doctor/')" -- core/plan
forbid "a JSON value of a cell file stays in core/cell" "$(include 'core/cell/cell_(field|motion)')" "$(door 'cell/(cell_(file|motion)|milling/tool_library)\.[ch]pp')" -- core server clients
forbid "verify shares nothing with the planners" "$(include 'core/(solid|picture|collision|search|motion|sweep|mill|doctor|place|timing|program|plan)/|core/trajectory/milling/(swept_voxels|swept_set|milled_stock)|core/material/(loose_pieces|support|flood|cavities|clamping|octree|block_graph)|core/cell/(chain|link_poses|ik)\.')" -- core/verify
forbid "verify has kinematics of its own" '(\.|->)chain\(\)|\b(LinkPoses|holder_shapes)\b' -- core/verify

# Every folder has its place in one of the orders, and a .cpp file without a header says itself what it is.
# expect_known LIST FOLDER...: each of the folders is in the list.
expect_known() {
  local known=" $1 " folder
  shift
  for folder in "$@"; do
    [[ ! -d $folder || $known == *" $(basename "$folder") "* ]] && continue
    printf 'fence: no rule for the folder %s\n' "$folder"
    breaches=$((breaches + 1))
  done
}
expect_known "${core_folders[*]}" core/*/
unsaid=$(find core proto server clients -name '*.cpp' 2>/dev/null | sort | while read -r file; do
  [ -f "${file%.cpp}.hpp" ] || [ "$(head -c 2 "$file")" = // ] || echo "$file"
done)
[ -z "$unsaid" ] || { printf 'fence: neither a header nor a first line says what it is\n%s\n' "$unsaid"; breaches=$((breaches + 1)); }

# The folders of the server, each above those before it; server/*.cpp joins them.
server_folders=(base files store fleet confine run queue results access net events api http ops)
expect_known "${server_folders[*]}" server/*/
for ((i = 0; i < ${#server_folders[@]}; ++i)); do
  above=$(IFS='|' && echo "${server_folders[*]:i+1}")
  forbid "server/${server_folders[i]} stands below ${above//|/, }" "$(include "server/(${above:+($above)/|}[a-z_]+\.hpp)")" -- "server/${server_folders[i]}"
done

# One door per heavy library. FCL takes several files in two folders; the headers that they share among themselves leave neither folder.
fcl_headers='collision/shape/fcl_shape|collision/shape/shape_contact|verify/robot/solid_body|verify/robot/cover_tree|verify/material/(standing_voxels|material_tree|convex_probe)|verify/tool_replay'
forbid "assimp only in mesh_file.cpp" "$(include 'assimp/')" "$(door 'mesh/mesh_file\.cpp')" -- core server proto clients
forbid "urdfdom only in robot.cpp" "$(include 'urdf_')" "$(door 'cell/robot\.cpp')" -- core server proto clients
forbid "TinyXML-2 only in mesh/collada.cpp, cell/urdf/urdf_guard.cpp and verify/robot/urdf_text.cpp" "$(include 'tinyxml2')" "$(door '(mesh/collada|cell/urdf/urdf_guard|verify/robot/urdf_text)\.cpp')" -- core server proto clients
forbid "FCL and octomap only in collision and verify" "$(include '(fcl|octomap)/')" "$(door "((collision|verify)/[a-z_/]+\.cpp|($fcl_headers)\.hpp)")" -- core server proto clients
forbid "the headers of collision that name FCL stay there" "$(include 'core/collision/shape/(fcl_shape|shape_contact)')" "$(door 'collision/[a-z_/]+\.[ch]pp')" -- core server clients
forbid "the headers of verify that name FCL stay there" "$(include 'core/verify/(robot/(solid_body|cover_tree)|material/(standing_voxels|material_tree|convex_probe)|tool_replay)')" "$(door 'verify/[a-z_/]+\.[ch]pp')" -- core server clients
forbid "Highway only in posture_lanes.cpp" "$(include 'hwy/')" "$(door 'sweep/field/posture_lanes\.cpp')" -- core server proto clients
forbid "libpng only in png_file.cpp" "$(include 'png\.h')" '^clients/cli/cell/png_file\.cpp$' -- core server proto clients
forbid "OMPL only in motion" "$(include 'ompl/')" "$(door 'motion/[a-z_]+\.cpp')" -- core server proto clients
forbid "JSON in core only where files are read or written" "$(include 'nlohmann/')" \
  "$(door '(cell/(cell_file\.cpp|cell_field\.hpp|milling/tool_library\.cpp)|doctor/(make/cell_text|findings_json)\.cpp|place/placed_cell\.cpp|timing/time_figures\.cpp|trajectory/([a-z_/]+\.cpp|text/line_fields\.hpp)|plan/(report\.cpp|checkpoint/(checkpoint\.cpp|(mill|path)_json\.[ch]pp)))')" -- core
forbid "libarchive only in zip_writer.cpp" "$(include 'archive(_entry)?\.h')" '^server/files/zip_writer\.cpp$' -- core server proto clients
forbid "libpq only in fleet/postgres.cpp" "$(include 'libpq')" '^server/fleet/postgres\.cpp$' -- core server proto clients
forbid "seccomp only in syscall_filter.cpp, Landlock only in file_fence.cpp" "$(include 'seccomp|linux/(seccomp|landlock)')" '^server/confine/(syscall_filter|file_fence)\.cpp$' -- core server proto clients

# No other header of core names a type of theirs.
forbid "no header of core names fcl::, ompl::, octomap:: or ai..." '\b(fcl|ompl|octomap|urdf)::|\bai(Scene|Mesh|Node|Vector3D)\b' "\.cpp$|$(door "($fcl_headers)\.hpp")" -- core

[ "$breaches" -eq 0 ] || { echo "fences: $breaches rules broken"; exit 1; }
echo "fences: all kept"
