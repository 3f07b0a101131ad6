// The time of a tick from C#.
using System;
using System.Diagnostics;
using Punctura;

static class Cost
{
    internal static void Print(string toml, Triple[,] rows)
    {
        using (Scene scene = Scene.FromToml(toml))
        using (var insertion = new Insertion(scene))
        {
            int n = rows.GetLength(0);
            double best = double.PositiveInfinity, sum = 0;
            for (int round = 0; round < 40; ++round)
            {
                insertion.Reset();
                var watch = Stopwatch.StartNew();
                for (int i = 0; i < n; ++i) sum += insertion.Step(rows[i, 0], rows[i, 1]).Y;
                best = Math.Min(best, watch.Elapsed.TotalMilliseconds);
            }
            if (sum != 0) Console.WriteLine("C#: Insertion.Step (Mono)\t" + (1e6 * best / n).ToString("0.0"));
        }
    }
}
