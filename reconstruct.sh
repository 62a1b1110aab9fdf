#!/usr/bin/env bash
# ./reconstruct.sh [VOLUME] [--output DIR] [--array NAME] [--tolerance T] [--control-points N]
#                  [--segments K] [--domain box|segments|auto|FILE]
#
# Turns a volume image into a T-spline and writes to DIR what came out of it: model.tspline,
# resampled.vti, hexes.vtu, bezier.vtu, picture.png, report.json and (segment by segment)
# report.csv. The first call on Debian 12 also installs what is missing and builds.
#
#   VOLUME              any image that ParaView reads (.vti .nrrd .nhdr .mhd .nii .vtk ...);
#                       without one a built-in hydrogen orbital is taken
#   --output DIR        folder of the results; default is output
#   --array NAME        point array to fit; default is the active one, or else the first
#   --tolerance T       stop when the RMS error is at most T percent of the array's range;
#                       default is 0.1, or no limit when --control-points is given
#   --control-points N  stop before there are more than N control points, those that cubes share
#                       counted once (distinct_control_points of report.json); default is 50000
#   --segments K        split the volume into K materials by texture and density; default is 0, as
#                       many as it seems to have. That writes segments.vti, boundary.vtp and
#                       segments.png; and, of segments for which there is a domain of cubes,
#                       patches.vtp, domain.vtu, fields.vti and hexmesh.vtu
#   --domain WHICH      auto, the default: a spline for each of the K materials over the cubes of its
#                       domain, or over its bounding box where that is more accurate, together still
#                       one T-spline that stands for every voxel; or one spline over the whole image
#                       if that is better still; segments: over the bounding boxes; box: over the
#                       whole image, without materials unless --segments is given; or a file with
#                       the cubes and corners of some segments: a domain.vtu, or a .json file
#                       (Documentation/UserGuide.md)
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export BUILD_DIR=${BUILD_DIR:-$source_dir/build}

usage() { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}"; }
fail() { echo "reconstruct: error: $*" >&2; exit 2; }

volume="" output=output array="" tolerance="" control_points="" segments="" domain=""
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --output | --array | --tolerance | --control-points | --segments | --domain)
      [ $# -ge 2 ] && [ -n "$2" ] || fail "$1 needs a value; see --help"
      name=${1#--}
      printf -v "${name//-/_}" %s "$2"
      shift ;;
    -*) fail "unknown option $1; see --help" ;;
    *) [ -z "$volume" ] || fail "one volume at a time, not '$volume' and '$1'"
       [ -n "$1" ] || fail "the name of the volume is empty"
       volume=$1 ;;
  esac
  shift
done
number='^([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][-+]?[0-9]+)?$'
[ -z "$tolerance" ] || [[ $tolerance =~ $number ]] ||
  fail "--tolerance is a percentage such as 0.5, not '$tolerance'"
[ -z "$control_points" ] || { [[ $control_points =~ ^[0-9]{2,9}$ ]] && ((10#$control_points >= 64)); } ||
  fail "--control-points is a whole number from 64 to 999999999, not '$control_points'"
[ -z "$segments" ] || { [[ $segments =~ ^[0-9]{1,2}$ ]] && ((10#$segments <= 64)); } ||
  fail "--segments is a whole number from 0 to 64, not '$segments'"
[ -z "$domain" ] || [[ $domain =~ ^(box|segments|auto)$ ]] || [ -f "$domain" ] ||
  fail "--domain is box, segments, auto or a file with cubes and corners, not '$domain'"
[ -z "$volume" ] || [ -f "$volume" ] || fail "there is no file '$volume'"
[ -z "$volume" ] || [ -r "$volume" ] || fail "the file '$volume' cannot be read"
mkdir -p -- "$output" 2>/dev/null || fail "the folder '$output' cannot be made"
[ -w "$output" ] || fail "nothing can be written to the folder '$output'"

"$source_dir/Utilities/setup.sh"
. "$BUILD_DIR/environment.sh"
exec "$source_dir/Utilities/with-display.sh" pvbatch "$source_dir/Utilities/reconstruct.py" \
  ${volume:+--volume "$volume"} --output "$output" ${array:+--array "$array"} \
  ${tolerance:+--tolerance "$tolerance"} ${control_points:+--control-points "$control_points"} \
  ${segments:+--segments "$segments"} ${domain:+--domain "$domain"}
