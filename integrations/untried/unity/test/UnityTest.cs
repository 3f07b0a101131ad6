// Compares the forces of the Unity component, with stand-ins for Unity, with those of the binding.
using System;
using System.Reflection;
using Punctura;
using UnityEngine;

static class UnityTest
{
    static void Call(object component, string method)
    {
        component.GetType().GetMethod(method, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(component, null);
    }

    /// Unity's positions are floats: so the same floats go through the binding for comparison.
    static void Main()
    {
        const double rate = 1600;
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
                    Test.Require(Test.Same(needle.ExactForce.Y, expected.Y), "force of the component in step " + k);
                    peak = Math.Max(peak, needle.Force.y);
                }
                Test.Require(peak > 0.5 && needle.Force.y < peak && needle.body.force.y == needle.Force.y, "a pop");
                Call(needle, "OnGUI");
                needle.body.force = new Vector3(0, 0, 0);
                needle.transform.position = new Vector3(0, float.NaN, 0);
                Call(needle, "FixedUpdate");
                Test.Require(needle.body.force.y == 0 && double.IsNaN(needle.ExactForce.Y), "no force at NaN for the body");
                Test.Require(GUI.Shown.StartsWith("needle: 0") && GUI.Shown.EndsWith(" N"), GUI.Shown);
                Console.WriteLine("component (stand-ins for Unity): peak " + peak.ToString("0.000") + " N, then " + GUI.Shown);
            }
        }
        Call(needle, "OnDisable");
    }
}
