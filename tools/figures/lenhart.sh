# shellcheck shell=bash
# Sourced after program.sh and `scratch`: imports the Lenhart knee of OpenSim-JAM as it is to $out/imported.toml, 55 strands of which 24
# wrap. Ends the script with 77 where the specimen is not there.
specimen=../shared/specimens/lenhart2015
needs "$specimen"

# The model names its cartilage by names of its own.
mkdir -p "$out/Geometry"
cp "$specimen/lenhart2015.osim" "$out"
for bone in femur tibia; do
  ln -sf "$(realpath "$specimen")/ACLC01-R-$bone-cart-medium.stl" "$out/Geometry/lenhart2015-R-$bone-cartilage.stl"
done
"$CONDYLE" import "$out/lenhart2015.osim" -o "$out/imported.toml" >/dev/null
