import{S as e,x as t}from"./index-Qc_W3yad.js";function n(n,r,i,a){return n.length<2?t:e`
    <div class="row" role="radiogroup" aria-label="Axis">
      ${n.map(t=>e`
          <label class="line">
            <input type="radio" name=${i} .checked=${t===r} @change=${()=>a(t)} />${t}
          </label>
        `)}
    </div>
  `}export{n as t};