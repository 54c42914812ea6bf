# Bounds are verified from the files of their fields by a script that does not use the program:
# a reaction, live weight with a cut-off, a factor of safety with water, obstacles on sand with a
# dead load, a block that slides without strain. Fields, loads and strengths that were changed are
# found, as are forgeries, and meshes and numbers that prove nothing.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$1.prm" --quiet --output "$2" --set 'Output/Certificates = true' \
    --set 'Analysis/Maximum levels = 1' --set 'Analysis/Gap tolerance = 9' \
    --set 'Output/Fields = false' --set 'Output/Pictures = false' --set 'Output/Expectations =' \
    --set 'Reference/Quantity =' || exit 1
}
run "$root/prm/limit_load/footing_rough" reaction
run "$root/prm/limit_load/vertical_cut_tension" weight
run "$root/prm/safety/slope_water" factor
run "$root/prm/limit_load/trapdoor" obstacles
cat >slide.prm <<'END'
subsection Analysis
  set Kind = limit load
end
subsection Geometry
  set Box = 0, 0; 1, 1
end
subsection Mesh
  set Type          = unstructured
  set Largest size  = 0.25
  set Smallest size = 0.25
end
subsection Materials
  set Names = block
  subsection block
    set Type     = Tresca
    set Density  = 2000
    set Cohesion = 1e7
  end
end
subsection Gravity
  set Acceleration = 0, -10
end
subsection Boundary conditions
  set Names = push
  subsection push
    set Sides      = left
    set Velocity x = 1
  end
end
subsection Obstacles
  set Names = base
  subsection base
    set Shape                = polygon
    set Vertices             = -1, -0.5; 2, -0.5; 2, 0; -1, 0
    set Friction coefficient = 0.3
  end
end
subsection Observation
  set Conditions = push
end
END
run slide rigid
/usr/bin/python3 -B "$root/tests/python/certificate.py" "$root/scripts/check_certificate"
