// Compares the forces of the binding and of the Unity component with those of the core.
//   Test.exe REFERENCE          with a second argument, only the time of a tick
using System;
using System.IO;
using System.Reflection;
using Punctura;
using UnityEngine;

static class Test
{
    static void Require(bool holds, string what)
    {
        if (!holds) throw new Exception("not so: " + what);
    }

    static long Bits(double x) { return BitConverter.DoubleToInt64Bits(x); }
    static bool Same(double a, double b) { return Bits(a) == Bits(b); }
    static bool Same(Triple a, Triple b) { return Same(a.X, b.X) && Same(a.Y, b.Y) && Same(a.Z, b.Z); }

    static Triple[,] ReadRows(string file)
    {
        byte[] bytes = File.ReadAllBytes(file);
        var rows = new Triple[bytes.Length / 72, 3];
        for (int i = 0; i < rows.GetLength(0); ++i)
            for (int j = 0; j < 3; ++j)
            {
                int at = 72 * i + 24 * j;
                rows[i, j] = new Triple(BitConverter.ToDouble(bytes, at), BitConverter.ToDouble(bytes, at + 8),
                                        BitConverter.ToDouble(bytes, at + 16));
            }
        return rows;
    }

    static void Binding(string toml, Triple[,] rows)
    {
        using (Scene scene = Scene.FromToml(toml))
        using (var stepped = new Insertion(scene))
        using (var peeked = new Insertion(scene))
        {
            int n = rows.GetLength(0);
            byte[] kept = null;
            for (int i = 0; i < n; ++i)
            {
                if (i == n / 2) kept = stepped.State;
                Require(Same(stepped.Step(rows[i, 0], rows[i, 1]), rows[i, 2]), "force " + i);
                peeked.Peek(new Triple(1, 2, 3), rows[i, 1]);
                Require(Same(peeked.Peek(rows[i, 0], rows[i, 1]), rows[i, 2]), "peeked force " + i);
                peeked.Commit();
            }
            stepped.State = kept;
            for (int i = n / 2; i < n; ++i)
                Require(Same(stepped.Step(rows[i, 0], rows[i, 1]), rows[i, 2]), "restored force " + i);
            Require(double.IsNaN(stepped.Step(new Triple(double.NaN, 0, 0), rows[0, 1]).X), "NaN for NaN");
            Console.WriteLine("binding: " + n + " forces equal the core's bit for bit, also peeked and restored");
        }
    }

    static void Errors(string toml)
    {
        try
        {
            Scene.FromToml(toml.Replace("friction", "frictoin"));
            Require(false, "an error for an unknown key");
        }
        catch (PuncturaException e) { Require(e.Message.Contains("membrane[0].frictoin"), e.Message); }
        using (Scene scene = Scene.FromToml(toml))
        {
            scene["membrane[0].friction"] = -1;
            try
            {
                new Insertion(scene);
                Require(false, "an error for a wrong number");
            }
            catch (PuncturaException e) { Require(e.Message.Contains("membrane[0].friction = -1"), e.Message); }
        }
        using (Scene scene = Scene.FromToml(toml))
        using (var insertion = new Insertion(scene))
        {
            try
            {
                insertion.Commit();
                Require(false, "an error for a commit without a peek");
            }
            catch (PuncturaException e) { Require(e.Message.Contains("no tick to commit"), e.Message); }
            Require(scene.Unusual() == "", scene.Unusual());
            scene["needle.diameter"] = 1.08;
            Require(scene.Unusual().Contains("If you meant 1.08 mm"), scene.Unusual());
        }
    }

    static void Device(string toml)
    {
        using (Scene scene = Scene.FromToml(toml))
        using (var servo = new Servo(scene))
        {
            double rate = scene["servo.rate"], strongest = 0;
            Sample sample = Sample.Healthy();
            servo.Arm();
            for (int k = 0; k < rate; ++k)
            {
                sample.Sequence = (ulong)k;
                sample.Time = k / rate;
                sample.Position = new Triple(0, 2e-3 - 9e-3 * k / rate, 0);
                Record record = servo.Step(sample);
                Require(record.State == ServoState.Active, "active in tick " + k);
                strongest = Math.Max(strongest, record.Force.Y);
            }
            Require(strongest > 0.5, "a force of the servo, " + strongest);
            sample.Position.X = double.NaN;
            Record faulted = servo.Step(sample);
            Require(faulted.State == ServoState.Faulted && faulted.Force.Y == 0, "a fault");
            Require(Servo.FaultText(faulted.Fault).Contains("not finite"), "the text of the fault");
        }
    }

    static void Call(object component, string method)
    {
        component.GetType().GetMethod(method, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(component, null);
    }

    /// Unity's positions are floats: so the same floats go through the binding for comparison.
    static void Component(double rate)
    {
        new PuncturaMembrane { name = "skin" };
        var needle = new PuncturaNeedle { name = "needle", body = new Rigidbody() };
        needle.transform.forward = new Vector3(0, -1, 0);
        needle.transform.position = new Vector3(0, 2e-3f, 0);
        Time.fixedDeltaTime = (float)(16 / rate);
        Call(needle, "OnEnable");
        using (var scene = new Scene("needle", 1.08f * 1e-3, 16f * Math.PI / 180, 0.4f * 1e3, 0.001f * 1e3))
        {
            scene.Add(new MembraneSettings
            {
                Stiffness = 0.57f * 1e3, Precompression = 0.41f, Friction = 0.2f, Thickness = 1f * 1e-3,
            });
            using (var insertion = new Insertion(scene))
            {
                double last = 2e-3f, peak = 0;
                Triple expected = new Triple();
                for (int k = 0; k < 100; ++k)
                {
                    float y = 2e-3f - 1e-4f * k;
                    needle.transform.position = new Vector3(0, y, 0);
                    Call(needle, "FixedUpdate");
                    for (int i = 1; i <= 16; ++i)
                    {
                        double now = i == 16 ? y : last + (y - last) * (i / 16.0);
                        expected = insertion.Step(new Triple(0, now, 0), new Triple(0, -1, 0));
                    }
                    last = y;
                    Require(Same(needle.ExactForce.Y, expected.Y), "force of the component in step " + k);
                    peak = Math.Max(peak, needle.Force.y);
                }
                Require(peak > 0.5 && needle.Force.y < peak && needle.body.force.y == needle.Force.y, "a pop");
                Call(needle, "OnGUI");
                needle.body.force = new Vector3(0, 0, 0);
                needle.transform.position = new Vector3(0, float.NaN, 0);
                Call(needle, "FixedUpdate");
                Require(needle.body.force.y == 0 && double.IsNaN(needle.ExactForce.Y), "no force at NaN for the body");
                Require(GUI.Shown.StartsWith("needle: 0") && GUI.Shown.EndsWith(" N"), GUI.Shown);
                Console.WriteLine("component (stand-ins for Unity): peak " + peak.ToString("0.000") + " N, then " + GUI.Shown);
            }
        }
        Call(needle, "OnDisable");
    }

    static int Main(string[] arguments)
    {
        string toml = File.ReadAllText(Path.Combine(arguments[0], "scene.toml"));
        Triple[,] rows = ReadRows(Path.Combine(arguments[0], "motion.f64"));
        if (arguments.Length > 1)
        {
            Cost.Print(toml, rows);
            return 0;
        }
        Binding(toml, rows);
        Errors(toml);
        Device(toml);
        Component(1600);
        return 0;
    }
}
