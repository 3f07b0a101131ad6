// Compares the forces of the binding with those of the core.
//   Test.exe REFERENCE          with a second argument, only the time of a tick
using System;
using System.IO;
using Punctura;

static class Test
{
    internal static void Require(bool holds, string what)
    {
        if (!holds) throw new Exception("not so: " + what);
    }

    static long Bits(double x) { return BitConverter.DoubleToInt64Bits(x); }
    internal static bool Same(double a, double b) { return Bits(a) == Bits(b); }
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

    static int Main(string[] arguments)
    {
        string toml = File.ReadAllText(Path.Combine(arguments[0], "scene.toml"));
        Triple[,] rows = ReadRows(Path.Combine(arguments[0], "motion.f64"));
        Binding(toml, rows);
        Errors(toml);
        Device(toml);
        return 0;
    }
}
