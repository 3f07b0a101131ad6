// Pushes a needle through the membranes of a scene file and prints the force.
//   Example.exe SCENE.toml
using System;
using System.IO;
using Punctura;

static class Example
{
    static int Main(string[] arguments)
    {
        try
        {
            using (Scene scene = Scene.FromToml(File.ReadAllText(arguments[0])))
            using (var insertion = new Insertion(scene))
            {
                double rate = scene["servo.rate"];
                for (int k = 0; k <= rate; ++k)
                {
                    double y = 1e-3 - 10e-3 * k / rate;
                    Triple force = insertion.Step(new Triple(0, y, 0), new Triple(0, -1, 0));
                    if (k % 80 == 0) Console.WriteLine("{0,6:0.00} mm  {1,7:0.0000} N", -1e3 * y, force.Y);
                }
            }
            return 0;
        }
        catch (PuncturaException e)
        {
            Console.Error.WriteLine(e.Message);
            return 1;
        }
    }
}
