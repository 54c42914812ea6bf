# The record of HDF5 files of all times is a VTKHDF file: its arrays are those of the files,
# its counts and offsets are those that the format asks for, on one rank and on two, where
# the number of points changes, too. The Python package reads it as it reads VTU files, and so
# does VTK's own reader where there is one that knows times (9.3, Debian 13).
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$@" --quiet --set 'Output/Report for tests = none' --set 'Output/Pictures = false' \
    --set 'Output/Fields = true' --set 'Output/Fields format = both' \
    --set 'Output/Expectations ='
}
for ranks in 1 2; do
  call=("$program")
  [ $ranks = 1 ] || call=(mpirun -np $ranks "$program")
  run "${call[@]}" "$root/tests/fem/footing-Q2-01.prm" --output fem$ranks \
    --set 'Loading/push/Duration = 0.06' --set 'Loading/push/Output every = 1'
  run "${call[@]}" "$root/tests/mpm/square-01.prm" --output mpm$ranks \
    --set 'Loading/turn/Duration = 0.1' --set 'Loading/turn/Output every = 2'
done
run "$program" "$root/prm/limit_load/footing_rough.prm" --output bounds \
  --set 'Analysis/Maximum levels = 1' --set 'Analysis/Gap tolerance = 9'
# Half of its points are dug away.
run "$program" "$root/tests/mpm/excavation-01.prm" --output dug --set 'Loading/dig/Output every = 1'
PYTHONPATH=$root/python /usr/bin/python3 -B - <<'PYTHON'
import pathlib, shutil
import h5py
import numpy as np
import geocone

seen = []
for record in sorted(pathlib.Path().glob("*/*.vtkhdf")):
    files = sorted(record.parent.glob(f"{record.stem}-*.h5"))
    with h5py.File(record) as file:
        top = file["VTKHDF"]
        assert top.attrs["Version"].tolist() == [2, 0]
        assert top.attrs["Type"] in (b"UnstructuredGrid", "UnstructuredGrid")
        steps = top["Steps"]
        n_steps = int(np.ravel(steps.attrs["NSteps"])[0])
        # Bounds are written once, at the end.
        assert n_steps == len(files) >= (1 if record.parent.name == "bounds" else 2)
        # The times of the other record.
        pvd = geocone.read(record.parent)
        assert np.allclose(steps["Values"], pvd.times(record.stem), rtol=1e-11, atol=0.)
        assert top["Types"].dtype == np.uint8
        names = set(top["PointData"])
        assert names == set(steps["PointDataOffsets"]) and len(names) > 2
        sizes, where = [], 0
        for step, path in enumerate(files):
            # As VTK's reader takes a state: a part, and where its arrays begin.
            part, point, cell, corner = (
                int(steps[name][step]) for name in (
                    "PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"))
            n_points, n_cells, n_corners = (
                int(top[name][part]) for name in (
                    "NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
            assert steps["NumberOfParts"][step] == 1
            offsets = top["Offsets"][cell + part:cell + part + n_cells + 1]
            corners = top["Connectivity"][corner:corner + n_corners]
            with h5py.File(path) as state:
                nodes, cells = state["nodes"][()], state["cells"][()]
                assert (n_points, n_cells) == (len(nodes), len(cells)) and point == where
                assert np.array_equal(offsets, np.arange(n_cells + 1) * cells.shape[1])
                assert np.array_equal(corners, cells.ravel())
                kind = {1: 1, 3: 5, 4: 9}[cells.shape[1]]
                assert set(top["Types"][cell:cell + n_cells]) == {kind}
                points = top["Points"][point:point + n_points]
                assert np.array_equal(points[:, :2], nodes) and not points[:, 2].any()
                assert names == set(state) - {"nodes", "cells"}
                for name in names:
                    assert steps["PointDataOffsets"][name][step] == point
                    assert np.array_equal(top["PointData"][name][point:point + n_points],
                                          state[name][()].squeeze(), equal_nan=True), name
            where += n_points
            sizes.append(n_points)
        # All that is in the arrays belongs to a state.
        assert len(top["Points"]) == where
        assert len(top["Offsets"]) == len(top["Types"]) + len(top["NumberOfCells"])
        seen.append((str(record), len(set(sizes))))
assert [name for name, _ in seen] == [
    "bounds/bounds.vtkhdf", "dug/cells.vtkhdf", "dug/points.vtkhdf", *(f"{kind}{ranks}/{series}.vtkhdf" for kind in ("fem", "mpm")
                              for ranks in (1, 2) for series in ("cells", "points"))], seen
assert dict(seen)["dug/points.vtkhdf"] == 2, seen

# Without the VTU files the package reads the same states from this record.
for folder, series in (("fem2", "cells"), ("fem2", "points"), ("mpm1", "points"), ("dug", "points"),
                       ("bounds", "bounds")):
    shutil.copytree(folder, "other")
    (pathlib.Path("other") / f"{series}.pvd").unlink()
    one, other = geocone.read(folder), geocone.read("other")
    assert other._record(series).suffix == ".vtkhdf"
    assert np.allclose(one.times(series), other.times(series), rtol=1e-11, atol=0.)
    for time in one.times(series):
        a, b = (run.fields(series, time=time) for run in (one, other))
        assert a.points.shape == b.points.shape and a.info["time"] == time
        assert a.cells[0].type == b.cells[0].type
        assert np.allclose(a.points, b.points, rtol=1e-6, atol=1e-7)
        assert np.array_equal(a.cells[0].data, b.cells[0].data)
        assert a.point_data.keys() == b.point_data.keys()
        for name in a.point_data:
            assert np.allclose(a.point_data[name], b.point_data[name], rtol=1e-6,
                               atol=1e-30, equal_nan=True), name
    shutil.rmtree("other")

# What is missing or damaged is told, with the name of the file.
def says(words, change):
    shutil.copytree("mpm1", "bad")
    path = pathlib.Path("bad")
    (path / "points.pvd").unlink()
    change(path)
    try:
        geocone.read("bad").fields("points")
        raise AssertionError(words)
    except geocone.ReadError as problem:
        assert words in str(problem) and "bad/points" in str(problem), problem
    shutil.rmtree("bad")
last = sorted(pathlib.Path("mpm1").glob("points-*.h5"))[-1].name
def cut(name):
    def change(path):
        data = (path / name).read_bytes()
        (path / name).write_bytes(data[:len(data) // 2])
    return change
says("cannot be read", lambda path: (path / last).unlink())
says("cannot be read", cut(last))
says("cannot be read", cut("points.vtkhdf"))
says("there is no file", lambda path: (path / "points.vtkhdf").unlink())

try:
    import vtk
    known = vtk.vtkVersion().GetVTKVersion() >= "9.3"
except ImportError:
    known = False
if known:
    pipeline = vtk.vtkStreamingDemandDrivenPipeline
    for name, _ in seen:
        reader = vtk.vtkHDFReader()
        reader.SetFileName(name)
        reader.UpdateInformation()
        times = reader.GetOutputInformation(0).Get(pipeline.TIME_STEPS())
        path = pathlib.Path(name)
        run = geocone.read(path.parent)
        assert np.allclose(times, run.times(path.stem), rtol=1e-11, atol=0.)
        for time in times:
            reader.UpdateTimeStep(time)
            grid = reader.GetOutputDataObject(0)
            grid = grid.GetPartition(0) if grid.IsA("vtkPartitionedDataSet") else grid
            mesh = run.fields(path.stem, time=time)
            assert grid.GetNumberOfPoints() == len(mesh.points)
            assert grid.GetNumberOfCells() == len(mesh.cells[0].data)
            assert np.allclose(grid.GetPoint(1)[:2], mesh.points[1], rtol=1e-6, atol=1e-7)
            data = grid.GetPointData()
            for name in mesh.point_data:
                assert np.allclose(data.GetArray(name).GetTuple(1),
                                   mesh.point_data[name][1], rtol=1e-6, equal_nan=True)
PYTHON
