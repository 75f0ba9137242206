#!/usr/bin/python3
"""Renders strip_roll_shape.png from a results.exo of examples/strip_roll/solid.yaml: the strip at several loads on its
roll, coloured by the axial Cauchy stress. Needs python3-vtk9 (and a display: xvfb-run does).

    xvfb-run python3 docs/figures/strip_roll_shape.py RESULTS
"""
import pathlib
import sys

import vtk

LOADS = (0.0, 0.002, 0.02, 0.06, 0.25)


def reader(file):
    r = vtk.vtkExodusIIReader()
    r.SetFileName(file)
    r.UpdateInformation()
    for i in range(r.GetNumberOfPointResultArrays()):
        r.SetPointResultArrayStatus(r.GetPointResultArrayName(i), 1)
    for i in range(r.GetNumberOfGlobalResultArrays()):
        r.SetGlobalResultArrayStatus(r.GetGlobalResultArrayName(i), 1)
    r.ApplyDisplacementsOn()
    return r


def strip(file, step):
    r = reader(file)
    r.SetTimeStep(step)
    surface = vtk.vtkCompositeDataGeometryFilter()
    surface.SetInputConnection(r.GetOutputPort())
    surface.Update()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface.GetOutput())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("nodal_stress_xx")
    mapper.SetScalarRange(-600, 600)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.5)
    return actor, mapper


def loads(file):
    """Load factor of every step."""
    r = reader(file)
    values = []
    for step in range(r.GetNumberOfTimeSteps()):
        r.SetTimeStep(step)
        r.Update()
        field = r.GetOutput().GetBlock(0).GetBlock(0).GetFieldData().GetArray("load_factor")
        values.append(field.GetValue(step if field.GetNumberOfTuples() > 1 else 0))
    return values


def main(folder):
    file = folder + "/results.exo"
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    history = loads(file)
    for load in LOADS:
        step = min(range(len(history)), key=lambda i: abs(history[i] - load))
        actor, mapper = strip(file, step)
        renderer.AddActor(actor)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(mapper.GetLookupTable())
    mapper.GetLookupTable().SetHueRange(0.66, 0.0)
    bar.SetTitle("stress_xx, MPa")
    bar.GetTitleTextProperty().SetColor(0, 0, 0)
    bar.GetLabelTextProperty().SetColor(0, 0, 0)
    bar.SetMaximumWidthInPixels(90)
    bar.SetPosition(0.89, 0.3)
    bar.SetHeight(0.5)
    renderer.AddActor(bar)

    source = vtk.vtkCylinderSource()
    source.SetRadius(50)
    source.SetHeight(40)
    source.SetResolution(180)
    source.SetCenter(200, 0, -54.4)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    roll = vtk.vtkActor()
    roll.SetMapper(mapper)
    roll.GetProperty().SetColor(0.8, 0.8, 0.8)
    renderer.AddActor(roll)

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.AddRenderer(renderer)
    window.SetSize(1000, 560)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(330, -700, 160)
    camera.SetFocalPoint(210, 0, -70)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.25)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(pathlib.Path(__file__).resolve().parent / "strip_roll_shape.png"))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
